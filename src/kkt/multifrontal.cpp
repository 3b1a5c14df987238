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

constexpr std::size_t padded(std::size_t n) {
  return (n + 3) / 4 * 4;
}

/// Rows there is room for, at least, that a front passes on; more are forced through.
constexpr std::size_t kLeastPassed = 16;

/// One front's factorisation by a known order of pivots: where every number goes, and the result.
struct Factor {
  std::size_t capacity = 0;   ///< rows there is room for
  std::size_t most_left = 0;  ///< candidates that may be passed on
  std::vector<std::size_t> children;
  std::size_t size = 0, candidates = 0, eliminated = 0, ld = 0;
  std::vector<std::uint32_t> ids;   ///< of the rows, in the order of pivots
  std::vector<std::uint8_t> order;  ///< of the pivots
  struct Move {
    std::uint32_t source, place;
  };
  std::vector<Move> hessian, diagonal, jacobian, flexibility;
  std::vector<std::uint32_t> to_parent;  ///< places of the Schur complement in the parent
  AlignedDoubles a;
  std::vector<double> inverse;

  std::size_t passed() const { return candidates - eliminated; }
  Block block(double* panel) const {
    return {a.get(), ld, size, eliminated, order.data(), const_cast<double*>(inverse.data()),
            panel};
  }
};

/// A forest of fronts, each taking over what its children could not eliminate (Duff & Reid, ACM
/// TOMS 9(3), 1983). The order of pivots is found by analyse(), and kept while every pivot stays
/// stable.
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
    panel_ = aligned_doubles(4 * padded(largest));
    rhs_ = aligned_doubles(padded(largest));
  }

  std::string name() const override { return name_; }
  void distrust() override { known_ = false; }

  Inertia factorize(const Values& values) override {
    Inertia inertia;
    if (known_ && run(values, inertia)) return inertia;
    inertia = analyse(values);
    known_ = inertia.zero == 0;
    if (!known_) return inertia;
    plan_places();
    Inertia again;
    if (!run(values, again)) {  // NaN among the numbers
      known_ = false;
      again.zero = 1;
    }
    return again;
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

  // --- finding the order -------------------------------------------------------------------
  Inertia analyse(const Values& values) {
    Inertia sum;
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      Factor& factor = factors_[k];
      start(plans_[k], factor);
      for_terms(plans_[k], values, [&](std::uint32_t a, std::uint32_t b, double number) {
        front_.add(place_[a], place_[b], number);
      });
      const Inertia part = front_.eliminate(factor.most_left);
      factor.eliminated = front_.eliminated();
      sum.positive += part.positive;
      sum.negative += part.negative;
      sum.zero += part.zero;
    }
    return sum;
  }

  /// Rows passed on, then the plan's own, with the children's Schur complements in place.
  void start(const FrontPlan& plan, Factor& factor) {
    std::size_t passed = 0;
    for (const std::size_t c : factor.children)
      for (std::size_t i = factors_[c].eliminated; i < factors_[c].candidates; ++i)
        factor.ids[passed++] = factors_[c].ids[i];
    std::copy(plan.ids.begin(), plan.ids.end(),
              factor.ids.begin() + static_cast<std::ptrdiff_t>(passed));
    factor.size = plan.ids.size() + passed;
    factor.candidates = plan.own + passed;
    factor.ld = padded(factor.size);
    front_.reset({factor.a.get(), factor.ld, factor.ids.data(), factor.order.data()}, factor.size,
                 factor.candidates);
    number(factor);
    for (const std::size_t c : factor.children) {
      const Factor& from = factors_[c];
      for (std::size_t col = from.eliminated; col < from.size; ++col)
        for (std::size_t row = col; row < from.size; ++row)
          front_.add(place_[from.ids[row]], place_[from.ids[col]], from.a[col * from.ld + row]);
    }
  }
  void number(const Factor& factor) {
    for (std::size_t i = 0; i < factor.size; ++i) place_[factor.ids[i]] = narrow(i);
  }

  /// Where each number goes when rows stand in the order of pivots.
  void plan_places() {
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      Factor& factor = factors_[k];
      number(factor);
      for (const std::size_t child : factor.children) plan_hand_over(factor, factors_[child]);
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
    }
  }
  static std::uint32_t place(const Factor& factor, std::uint32_t i, std::uint32_t j) {
    return narrow(std::min(i, j) * factor.ld + std::max(i, j));
  }
  void plan_hand_over(const Factor& to, Factor& from) const {
    from.to_parent.clear();
    for (std::size_t col = from.eliminated; col < from.size; ++col)
      for (std::size_t row = col; row < from.size; ++row)
        from.to_parent.push_back(place(to, place_[from.ids[row]], place_[from.ids[col]]));
  }

  // --- by the known order ------------------------------------------------------------------
  bool run(const Values& values, Inertia& inertia) {
    const BlockKernels& kernels = block_kernels();
    for (std::size_t k = 0; k < factors_.size(); ++k) {
      Factor& factor = factors_[k];
      double* a = factor.a.get();
      clear_lower(factor);
      for (const std::size_t child : factor.children) hand_over(factors_[child], a);
      add(factor.hessian, values.hessian, a);
      add(factor.diagonal, values.diagonal, a);
      add(factor.jacobian, values.jacobian, a);
      for (const auto& move : factor.flexibility) a[move.place] -= values.flexibility[move.source];
      if (!kernels.factor(factor.block(panel_.get()), inertia)) return false;
      if (values.minimum_only && plans_[k].equations_so_far != kNoFront &&
          inertia.negative > plans_[k].equations_so_far)
        return true;
    }
    return true;
  }
  static void add(const std::vector<Factor::Move>& moves, std::span<const double> numbers,
                  double* a) {
    for (const auto& move : moves) a[move.place] += numbers[move.source];
  }
  /// Zeros on and below the diagonal, and in the vectors that hold it.
  static void clear_lower(Factor& factor) {
    for (std::size_t c = 0; c < factor.size; ++c) {
      const std::size_t begin = c & ~std::size_t{3};
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
  Front front_{0};                    ///< for analyse()
  bool known_ = false;
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
