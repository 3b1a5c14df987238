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

/// One front's factorisation by a known order of pivots: where every number goes, and the result.
struct Factor {
  std::size_t capacity = 0;  ///< rows there is room for
  std::size_t size = 0, eliminated = 0, ld = 0;
  std::vector<std::uint32_t> ids;   ///< of the rows, in the order of pivots
  std::vector<std::uint8_t> order;  ///< of the pivots
  struct Move {
    std::uint32_t source, place;
  };
  std::vector<Move> hessian, diagonal, jacobian, flexibility;
  std::vector<std::uint32_t> to_next;  ///< places of the Schur complement in the next front
  AlignedDoubles a;
  std::vector<double> inverse;

  Block block(double* panel) const {
    return {a.get(), ld, size, eliminated, order.data(), const_cast<double*>(inverse.data()),
            panel};
  }
};

/// A chain of fronts, each taking over what the one before could not eliminate. The order of pivots
/// is found by analyse(), and kept while every pivot stays stable.
class Chain final : public Backend {
 public:
  Chain(std::string name, const Pattern& pattern, std::vector<FrontPlan> plans)
      : name_(std::move(name)),
        fixed_(pattern.fixed),
        plans_(std::move(plans)),
        place_(pattern.variables + pattern.equations, 0),
        fronts_{Front(most_rows(plans_)), Front(most_rows(plans_))} {
    // Room for all the rows of the two stages before it; a longer backlog is forced through.
    std::size_t before = 0, last = 0, largest = 0;
    for (const auto& plan : plans_) {
      factors_.emplace_back();
      reserve(plan, plan.ids.size() + before + last, factors_.back());
      largest = std::max(largest, factors_.back().capacity);
      before = last;
      last = plan.own;
    }
    for (std::size_t k = 0; k + 1 < plans_.size(); ++k) {
      const std::size_t most = factors_[k].capacity;
      factors_[k].to_next.reserve(most * (most + 1) / 2);
    }
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
  static std::size_t most_rows(const std::vector<FrontPlan>& plans) {
    std::size_t most = 0, before = 0, last = 0;
    for (const auto& plan : plans) {
      most = std::max(most, plan.ids.size() + before + last);
      before = last;
      last = plan.own;
    }
    return most;
  }

  static void reserve(const FrontPlan& plan, std::size_t rows, Factor& factor) {
    factor.capacity = rows;
    factor.ids.reserve(rows);
    factor.order.reserve(rows);
    factor.hessian.reserve(plan.hessian.size());
    factor.diagonal.reserve(plan.diagonal.size());
    factor.jacobian.reserve(plan.jacobian.size());
    factor.flexibility.reserve(plan.flexibility.size());
    factor.a = aligned_doubles(padded(rows) * (rows + 1));
    factor.inverse.resize(2 * rows + 2);
  }

  static void load(const Factor& factor, std::span<const double> rhs, double* y) {
    for (std::size_t i = 0; i < factor.size; ++i) y[i] = rhs[factor.ids[i]];
    for (std::size_t i = factor.size; i < factor.ld; ++i) y[i] = 0;
  }

  // --- finding the order -------------------------------------------------------------------
  Inertia analyse(const Values& values) {
    Inertia sum;
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      const Front* previous = k > 0 ? &fronts_[(k - 1) % 2] : nullptr;
      Front& front = fronts_[k % 2];
      start(plans_[k], previous, front);
      for_terms(plans_[k], values, [&](std::uint32_t a, std::uint32_t b, double number) {
        front.at(place_[a], place_[b]) += number;
      });
      const std::size_t passed = previous ? previous->remaining_candidates() : 0;
      const bool crowded = k > 0 && passed > plans_[k - 1].own;  // the next front has no more room
      const Inertia part = front.eliminate(k + 1 == plans_.size() || crowded);
      sum.positive += part.positive;
      sum.negative += part.negative;
      sum.zero += part.zero;
      note(front, factors_[k]);
    }
    return sum;
  }

  /// Rows passed on, then the plan's own, with the previous front's Schur complement in place.
  void start(const FrontPlan& plan, const Front* previous, Front& front) {
    const std::size_t passed = previous ? previous->remaining_candidates() : 0;
    front.reset(plan.ids.size() + passed, plan.own + passed);
    const auto ids = front.ids();
    for (std::size_t i = 0; i < passed; ++i) ids[i] = previous->ids()[previous->eliminated() + i];
    std::copy(plan.ids.begin(), plan.ids.end(), ids.begin() + static_cast<std::ptrdiff_t>(passed));
    for (std::size_t i = 0; i < ids.size(); ++i) place_[ids[i]] = narrow(i);
    if (previous == nullptr) return;
    const auto from = previous->ids();
    for (std::size_t col = previous->eliminated(); col < previous->size(); ++col)
      for (std::size_t row = col; row < previous->size(); ++row)
        front.at(place_[from[row]], place_[from[col]]) += previous->at(row, col);
  }

  static void note(const Front& front, Factor& factor) {
    factor.size = front.size();
    factor.eliminated = front.eliminated();
    factor.ld = padded(front.size());
    factor.ids.assign(front.ids().begin(), front.ids().end());
    factor.order.assign(front.order().begin(), front.order().end());
  }

  /// Where each number goes when rows stand in the order of pivots.
  void plan_places() {
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      Factor& factor = factors_[k];
      for (std::size_t i = 0; i < factor.size; ++i) place_[factor.ids[i]] = narrow(i);
      if (k > 0) plan_hand_over(factor, factors_[k - 1]);
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
    from.to_next.clear();
    for (std::size_t col = from.eliminated; col < from.size; ++col)
      for (std::size_t row = col; row < from.size; ++row)
        from.to_next.push_back(place(to, place_[from.ids[row]], place_[from.ids[col]]));
  }

  // --- by the known order ------------------------------------------------------------------
  bool run(const Values& values, Inertia& inertia) {
    const BlockKernels& kernels = block_kernels();
    for (std::size_t k = 0; k < factors_.size(); ++k) {
      Factor& factor = factors_[k];
      double* a = factor.a.get();
      clear_lower(factor);
      if (k > 0) hand_over(factors_[k - 1], a);
      add(factor.hessian, values.hessian, a);
      add(factor.diagonal, values.diagonal, a);
      add(factor.jacobian, values.jacobian, a);
      for (const auto& move : factor.flexibility) a[move.place] -= values.flexibility[move.source];
      if (!kernels.factor(factor.block(panel_.get()), inertia)) return false;
      if (values.minimum_only && inertia.negative > plans_[k].equations_so_far) return true;
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
    const std::uint32_t* place = from.to_next.data();
    for (std::size_t col = from.eliminated; col < from.size; ++col)
      for (std::size_t row = col; row < from.size; ++row)
        to[*place++] += from.a[col * from.ld + row];
  }

  std::string name_;
  std::vector<char> fixed_;
  std::vector<FrontPlan> plans_;
  std::vector<Factor> factors_;
  std::vector<std::uint32_t> place_;  ///< of each id in the front at hand
  Front fronts_[2];                   ///< for analyse(): the one at hand and the one before
  bool known_ = false;
  AlignedDoubles panel_, rhs_;
};

}  // namespace

std::unique_ptr<Backend> make_stage_ldlt(const Pattern& pattern) {
  return std::make_unique<Chain>("stage_ldlt", pattern, plan_chain(pattern));
}
std::unique_ptr<Backend> make_dense_ldlt(const Pattern& pattern) {
  return std::make_unique<Chain>("dense_ldlt", pattern, plan_whole(pattern));
}

}  // namespace slalom::kkt
