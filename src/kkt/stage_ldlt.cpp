#include <algorithm>

#include "assembly.hpp"
#include "front.hpp"
#include "slalom/kkt/system.hpp"

namespace slalom::kkt {
namespace {

void add(Inertia& sum, const Inertia& part) {
  sum.positive += part.positive;
  sum.negative += part.negative;
  sum.zero += part.zero;
}

/// The right-hand side by id: variables, then one multiplier a row.
class Stacked {
 public:
  explicit Stacked(const Pattern& pattern)
      : pattern_(pattern), values_(pattern.variables + pattern.rows()) {}

  std::span<double> load(std::span<const double> a, std::span<const double> b) {
    std::copy(a.begin(), a.end(), values_.begin());
    for (std::size_t r = 0; r < b.size(); ++r)
      values_[pattern_.variables + r] = pattern_.equation[r] ? b[r] : 0;
    return values_;
  }
  void store(std::span<double> a, std::span<double> b) const {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = pattern_.fixed[i] ? 0 : values_[i];
    for (std::size_t r = 0; r < b.size(); ++r)
      if (pattern_.equation[r]) b[r] = values_[pattern_.variables + r];
  }

 private:
  const Pattern& pattern_;
  std::vector<double> values_;
};

class StageLdlt final : public Backend {
 public:
  explicit StageLdlt(const Pattern& pattern)
      : pattern_(pattern), plans_(plan_chain(pattern_)), stacked_(pattern_) {
    // Room for all the rows of the two stages before it; a longer backlog is forced through.
    std::size_t before = 0, last = 0;
    for (const auto& plan : plans_) {
      fronts_.emplace_back(plan.ids.size() + before + last);
      before = last;
      last = plan.own;
    }
  }

  std::string name() const override { return "stage_ldlt"; }

  Inertia factorize(const Values& values) override {
    Inertia inertia;
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      const Front* previous = k > 0 ? &fronts_[k - 1] : nullptr;
      const std::size_t passed = previous ? previous->remaining_candidates() : 0;
      Front& front = fronts_[k];
      front.reset(plans_[k].ids.size() + passed, plans_[k].own + passed);
      std::copy(plans_[k].ids.begin(), plans_[k].ids.end(),
                front.ids().begin() + static_cast<std::ptrdiff_t>(passed));
      if (previous) take_over(*previous, plans_[k - 1].next, passed, plans_[k], front);
      assemble(plans_[k], values, passed, front);
      const bool crowded = k > 0 && passed > plans_[k - 1].own;  // the next front has no more room
      add(inertia, front.eliminate(k + 1 == plans_.size() || crowded));
    }
    return inertia;
  }

  void solve(std::span<double> a, std::span<double> b) const override {
    const auto rhs = stacked_.load(a, b);
    for (const auto& front : fronts_) front.forward(rhs);
    for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) front->backward(rhs);
    stacked_.store(a, b);
  }

 private:
  /// Adds the previous front's Schur complement: rows passed on, next stage, border.
  static void take_over(const Front& from, std::size_t next, std::size_t passed,
                        const FrontPlan& plan, Front& to) {
    const std::size_t first = from.eliminated(), rows = from.size() - first;
    const std::size_t border = rows - passed - next;
    const std::size_t border_at = passed + plan.ids.size() - border;
    const auto place = [&](std::size_t i) {
      return i < passed + next ? i : border_at + (i - passed - next);
    };
    for (std::size_t i = 0; i < passed; ++i) to.ids()[i] = from.ids()[first + i];
    for (std::size_t col = 0; col < rows; ++col)
      for (std::size_t row = col; row < rows; ++row)
        to.at(place(row), place(col)) += from.at(first + row, first + col);
  }

  const Pattern pattern_;
  std::vector<FrontPlan> plans_;
  std::vector<Front> fronts_;
  mutable Stacked stacked_;
};

class DenseLdlt final : public Backend {
 public:
  explicit DenseLdlt(const Pattern& pattern)
      : pattern_(pattern),
        plan_(plan_whole(pattern_)),
        front_(plan_.ids.size()),
        stacked_(pattern_) {}

  std::string name() const override { return "dense_ldlt"; }

  Inertia factorize(const Values& values) override {
    front_.reset(plan_.ids.size(), plan_.own);
    std::copy(plan_.ids.begin(), plan_.ids.end(), front_.ids().begin());
    assemble(plan_, values, 0, front_);
    return front_.eliminate(true);
  }

  void solve(std::span<double> a, std::span<double> b) const override {
    const auto rhs = stacked_.load(a, b);
    front_.forward(rhs);
    front_.backward(rhs);
    stacked_.store(a, b);
  }

 private:
  const Pattern pattern_;
  FrontPlan plan_;
  Front front_;
  mutable Stacked stacked_;
};

}  // namespace

std::unique_ptr<Backend> make_stage_ldlt(const Pattern& pattern) {
  return std::make_unique<StageLdlt>(pattern);
}
std::unique_ptr<Backend> make_dense_ldlt(const Pattern& pattern) {
  return std::make_unique<DenseLdlt>(pattern);
}

}  // namespace slalom::kkt
