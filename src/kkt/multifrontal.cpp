#include <algorithm>
#include <memory>

#include "../base/aligned.hpp"
#include "assembly.hpp"
#include "block.hpp"
#include "front.hpp"
#include "slalom/kkt/system.hpp"

namespace slalom::kkt {
namespace {

std::uint32_t narrow(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

/// To whole vectors of the widest kind.
constexpr std::size_t padded(std::size_t n) {
  return (n + kMostLanes - 1) / kMostLanes * kMostLanes;
}

/// Rows there is room for, at least, that a front passes on; more are forced through.
constexpr std::size_t kLeastPassed = 16;

/// Multiplications after which Values::stop is asked: some ten microseconds' worth, so that asking
/// costs nothing beside them.
constexpr double kAskAfter = 2e5;

/// One front's factorisation by a known order of pivots: where every number goes, and the result.
struct Factor {
  std::size_t capacity = 0;   ///< rows there is room for
  std::size_t most_left = 0;  ///< candidates that may be passed on
  std::vector<std::size_t> children;
  std::size_t size = 0, candidates = 0, eliminated = 0, ld = 0;
  std::size_t received = 0;            ///< rows passed on by its children
  std::vector<std::uint32_t> ids;      ///< of the rows, in the order of pivots
  std::vector<std::uint32_t> natural;  ///< of each row: its place among what came and its own
  std::vector<std::uint8_t> order;     ///< of the pivots
  bool known = false;                  ///< the order is one to go by
  bool placed = false;                 ///< moves fit the order
  bool handed = false;                 ///< so does to_parent
  struct Move {
    std::uint32_t source, place;
  };
  std::vector<Move> hessian, diagonal, jacobian, flexibility;
  std::vector<std::uint32_t> to_parent;  ///< places of the Schur complement in the parent
  AlignedDoubles a;
  std::vector<double> inverse;

  std::size_t passed() const { return candidates - eliminated; }
  Block block(double* panel, double least_ratio = 0) const {
    return {a.get(),    ld,           size,
            eliminated, order.data(), const_cast<double*>(inverse.data()),
            panel,      least_ratio};
  }
};

/// A forest of fronts, each taking over what its children could not eliminate (Duff & Reid, ACM
/// TOMS 9(3), 1983).
///
/// A front's order of pivots is the one it had as long as every pivot stays stable. Anew it is the
/// order of the front before, where that is of the same shape and stable enough here, for the
/// stages of a chain are much alike; else it is searched for. After distrust() all are found anew,
/// and depend on nothing from before.
class Multifrontal final : public Backend {
 public:
  Multifrontal(std::string name, const Pattern& pattern, std::vector<FrontPlan> plans)
      : name_(std::move(name)),
        fixed_(pattern.fixed),
        plans_(std::move(plans)),
        factors_(plans_.size()),
        place_(pattern.variables + pattern.equations, 0) {
    std::size_t largest = 0;
    plan_rooms();
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      reserve(plans_[k], factors_[k]);
      largest = std::max(largest, factors_[k].capacity);
    }
    front_ = Front(largest);
    gathered_.resize(largest);
    panel_ = aligned_doubles(4 * padded(largest));
    rhs_ = aligned_doubles(padded(largest));
  }

  std::string name() const override { return name_; }
  void distrust() override {
    for (auto& factor : factors_) factor.known = false;
  }

  Inertia factorize(const Values& values) override {
    Inertia sum;
    double work = 0;
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      if (values.stop != nullptr && work > kAskAfter) {
        if (values.stop(values.stop_data)) break;
        work = 0;
      }
      Inertia part;
      factorize_front(k, values, part);
      sum.positive += part.positive;
      sum.negative += part.negative;
      sum.zero += part.zero;
      const auto size = static_cast<double>(factors_[k].size);
      work += size * size * static_cast<double>(factors_[k].eliminated) / 2;
      const bool too_many =
          plans_[k].equations_so_far != kNoFront && sum.negative > plans_[k].equations_so_far;
      if (part.zero > 0 || (values.minimum_only && too_many)) break;
    }
    return sum;
  }

  void solve(std::span<double> rhs) override {
    const BlockKernels& kernels = block_kernels();
    double* y = rhs_.get();
    for (const auto& factor : factors_) {
      load(factor, rhs, y);
      kernels.forward(factor.block(panel_.get()), y);
      for (std::size_t i = 0; i < factor.size; ++i) rhs[factor.ids[i]] = y[i];
    }
    for (auto factor = factors_.rbegin(); factor != factors_.rend(); ++factor) {
      load(*factor, rhs, y);
      kernels.backward(factor->block(panel_.get()), y);
      for (std::size_t i = 0; i < factor->eliminated; ++i) rhs[factor->ids[i]] = y[i];
    }
    for (std::size_t i = 0; i < fixed_.size(); ++i)
      if (fixed_[i]) rhs[i] = 0;
  }

 private:
  /// Room for what two generations of fronts may pass on.
  void plan_rooms() {
    std::vector<std::size_t> below(plans_.size(), 0);
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      Factor& factor = factors_[k];
      std::size_t children = 0;
      factor.capacity = plans_[k].ids.size();
      below[k] += plans_[k].own;
      for (const std::size_t child : factor.children) {
        children += plans_[child].own;
        factor.capacity += factors_[child].most_left;
      }
      const std::size_t parent = plans_[k].parent;
      if (parent == kNoFront) continue;
      factors_[parent].children.push_back(k);
      below[parent] += below[k];
      factor.most_left = std::min(below[k], std::max(kLeastPassed, plans_[k].own + children));
    }
  }

  static void reserve(const FrontPlan& plan, Factor& factor) {
    const std::size_t rows = factor.capacity;
    factor.ids.resize(rows);
    factor.natural.resize(rows);
    factor.order.resize(rows);
    factor.hessian.reserve(plan.hessian.size());
    factor.diagonal.reserve(plan.diagonal.size());
    factor.jacobian.reserve(plan.jacobian.size());
    factor.flexibility.reserve(plan.flexibility.size());
    factor.a = aligned_doubles(padded(rows) * (rows + 1));
    factor.inverse.resize(2 * rows + 2);
    if (plan.parent != kNoFront) factor.to_parent.reserve(rows * (rows + 1) / 2);
  }

  static void load(const Factor& factor, std::span<const double> rhs, double* y) {
    for (std::size_t i = 0; i < factor.size; ++i) y[i] = rhs[factor.ids[i]];
    for (std::size_t i = factor.size; i < factor.ld; ++i) y[i] = 0;
  }

  // --- the order of pivots -----------------------------------------------------------------
  void factorize_front(std::size_t k, const Values& values, Inertia& inertia) {
    Factor& factor = factors_[k];
    const bool was_known = factor.known && gathers_the_same(k);
    if (was_known || foresee(k)) {
      plan_places(k);
      factor.known = by_order(k, values, was_known ? kLeastRatio : kFoundRatio, inertia);
      if (factor.known) return;
    }
    search(k, values, inertia);
    if (inertia.zero > 0) return;
    inertia = {};
    plan_places(k);
    factor.known = by_order(k, values, kLeastRatio, inertia);
    if (!factor.known) inertia.zero = 1;  // NaN among the numbers
  }

  /// Rows passed on by the children, then the plan's own, into gathered_.
  std::size_t gather(std::size_t k) {
    std::size_t received = 0;
    for (const std::size_t c : factors_[k].children)
      for (std::size_t i = factors_[c].eliminated; i < factors_[c].candidates; ++i)
        gathered_[received++] = factors_[c].ids[i];
    std::copy(plans_[k].ids.begin(), plans_[k].ids.end(),
              gathered_.begin() + static_cast<std::ptrdiff_t>(received));
    return received;
  }
  /// Whether the rows are those the order is of.
  bool gathers_the_same(std::size_t k) {
    const Factor& factor = factors_[k];
    const bool current = std::all_of(factor.children.begin(), factor.children.end(),
                                     [&](std::size_t c) { return factors_[c].handed; });
    if (current) return true;
    if (gather(k) != factor.received) return false;
    for (std::size_t i = 0; i < factor.size; ++i)
      if (factor.ids[i] != gathered_[factor.natural[i]]) return false;
    return true;
  }

  /// Takes the order of the front before, if that is of the same shape.
  bool foresee(std::size_t k) {
    if (k == 0) return false;
    const Factor& like = factors_[k - 1];
    Factor& factor = factors_[k];
    const std::size_t received = gather(k), size = plans_[k].ids.size() + received;
    if (!like.known || like.size != size || like.received != received ||
        plans_[k].own != plans_[k - 1].own || like.candidates - like.eliminated > factor.most_left)
      return false;
    bool same =
        factor.placed && factor.size == size && factor.eliminated == like.eliminated &&
        std::equal(like.order.begin(), like.order.begin() + like.eliminated, factor.order.begin());
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t id = gathered_[like.natural[i]];
      same = same && factor.ids[i] == id;
      factor.ids[i] = id;
    }
    std::copy_n(like.natural.begin(), size, factor.natural.begin());
    if (same) return true;
    std::copy_n(like.order.begin(), like.eliminated, factor.order.begin());
    set_shape(k, received);
    factor.eliminated = like.eliminated;
    return true;
  }
  void set_shape(std::size_t k, std::size_t received) {
    Factor& factor = factors_[k];
    factor.received = received;
    factor.size = plans_[k].ids.size() + received;
    factor.candidates = plans_[k].own + received;
    factor.ld = padded(factor.size);
    factor.placed = factor.handed = false;
  }

  void search(std::size_t k, const Values& values, Inertia& inertia) {
    Factor& factor = factors_[k];
    set_shape(k, gather(k));
    std::copy_n(gathered_.begin(), factor.size, factor.ids.begin());
    front_.reset({factor.a.get(), factor.ld, factor.ids.data(), factor.order.data()}, factor.size,
                 factor.candidates);
    number(factor);
    for (const std::size_t c : factor.children) {
      const Factor& from = factors_[c];
      for (std::size_t col = from.eliminated; col < from.size; ++col)
        for (std::size_t row = col; row < from.size; ++row)
          front_.add(place_[from.ids[row]], place_[from.ids[col]], from.a[col * from.ld + row]);
    }
    for_terms(plans_[k], values, [&](std::uint32_t a, std::uint32_t b, double value) {
      front_.add(place_[a], place_[b], value);
    });
    inertia = front_.eliminate(factor.most_left);
    factor.eliminated = front_.eliminated();
    for (std::size_t i = 0; i < factor.size; ++i) factor.natural[i] = place_[factor.ids[i]];
  }
  void number(const Factor& factor) {
    for (std::size_t i = 0; i < factor.size; ++i) place_[factor.ids[i]] = narrow(i);
  }

  /// Where each number goes when rows stand in the order of pivots.
  void plan_places(std::size_t k) {
    Factor& factor = factors_[k];
    const bool current =
        factor.placed && std::all_of(factor.children.begin(), factor.children.end(),
                                     [&](std::size_t c) { return factors_[c].handed; });
    if (current) return;
    number(factor);
    for (const std::size_t child : factor.children) plan_hand_over(factor, factors_[child]);
    if (factor.placed) return;
    const auto places = [&](const std::vector<FrontPlan::Term>& terms,
                            std::vector<Factor::Move>& list) {
      list.clear();
      for (const auto& term : terms)
        list.push_back({term.source, place(factor, place_[term.a], place_[term.b])});
    };
    places(plans_[k].hessian, factor.hessian);
    places(plans_[k].diagonal, factor.diagonal);
    places(plans_[k].jacobian, factor.jacobian);
    places(plans_[k].flexibility, factor.flexibility);
    factor.placed = true;
  }
  static std::uint32_t place(const Factor& factor, std::uint32_t i, std::uint32_t j) {
    return narrow(std::min(i, j) * factor.ld + std::max(i, j));
  }
  void plan_hand_over(const Factor& to, Factor& from) const {
    from.to_parent.clear();
    for (std::size_t col = from.eliminated; col < from.size; ++col)
      for (std::size_t row = col; row < from.size; ++row)
        from.to_parent.push_back(place(to, place_[from.ids[row]], place_[from.ids[col]]));
    from.handed = true;
  }

  // --- by a given order --------------------------------------------------------------------
  bool by_order(std::size_t k, const Values& values, double least_ratio, Inertia& inertia) {
    Factor& factor = factors_[k];
    double* a = factor.a.get();
    clear_lower(factor);
    for (const std::size_t child : factor.children) hand_over(factors_[child], a);
    add(factor.hessian, values.hessian, a);
    add(factor.diagonal, values.diagonal, a);
    add(factor.jacobian, values.jacobian, a);
    for (const auto& move : factor.flexibility) a[move.place] -= values.flexibility[move.source];
    return block_kernels().factor(factor.block(panel_.get(), least_ratio), inertia);
  }
  static void add(const std::vector<Factor::Move>& moves, std::span<const double> numbers,
                  double* a) {
    for (const auto& move : moves) a[move.place] += numbers[move.source];
  }
  /// Zeros on and below the diagonal, and in the vectors that hold it.
  static void clear_lower(Factor& factor) {
    for (std::size_t c = 0; c < factor.size; ++c) {
      const std::size_t begin = c & ~(kMostLanes - 1);
      std::fill_n(factor.a.get() + c * factor.ld + begin, factor.ld - begin, 0.0);
    }
  }
  static void hand_over(const Factor& from, double* to) {
    const std::uint32_t* place = from.to_parent.data();
    for (std::size_t col = from.eliminated; col < from.size; ++col)
      for (std::size_t row = col; row < from.size; ++row)
        to[*place++] += from.a[col * from.ld + row];
  }

  std::string name_;
  std::vector<char> fixed_;
  std::vector<FrontPlan> plans_;
  std::vector<Factor> factors_;
  std::vector<std::uint32_t> place_;  ///< of each id in the front at hand
  std::vector<std::uint32_t> gathered_;
  Front front_{0};  ///< for search()
  AlignedDoubles panel_, rhs_;
};

}  // namespace

std::unique_ptr<Backend> make_stage_ldlt(const Pattern& pattern) {
  return std::make_unique<Multifrontal>("stage_ldlt", pattern, plan_chain(pattern));
}
std::unique_ptr<Backend> make_sparse_ldlt(const Pattern& pattern) {
  return std::make_unique<Multifrontal>("sparse_ldlt", pattern, plan_forest(pattern));
}

}  // namespace slalom::kkt
