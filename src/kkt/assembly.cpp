#include "assembly.hpp"

#include <algorithm>

#include "slalom/base/error.hpp"

namespace slalom::kkt {
namespace {

std::uint32_t narrow(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

/// Distributes the system's entries over the fronts, given the front of each id.
class Planner {
 public:
  Planner(const Pattern& pattern, std::vector<std::size_t> front_of, std::size_t fronts)
      : p_(pattern), front_(std::move(front_of)), plans_(fronts) {}

  std::vector<FrontPlan> run() {
    add_rows();
    for (std::size_t e = 0; e < p_.hessian.size(); ++e)
      add(&FrontPlan::hessian, e, p_.hessian[e].row, p_.hessian[e].col);
    for (std::size_t i = 0; i < p_.variables; ++i) add(&FrontPlan::diagonal, i, i, i);
    for (const auto& entry : p_.jacobian)
      add(&FrontPlan::jacobian, entry.source, p_.variables + entry.equation, entry.variable);
    for (std::size_t e = 0; e < p_.equations; ++e)
      add(&FrontPlan::flexibility, e, p_.variables + e, p_.variables + e);
    return std::move(plans_);
  }

 private:
  void add_rows() {
    for (std::size_t i = 0; i < p_.variables; ++i)
      if (!p_.fixed[i]) plans_[front_[i]].ids.push_back(narrow(i));
    std::vector<std::size_t> variables;
    for (auto& plan : plans_) variables.push_back(plan.ids.size());
    for (std::size_t e = 0; e < p_.equations; ++e)
      plans_[front_[p_.variables + e]].ids.push_back(narrow(p_.variables + e));
    std::size_t equations = 0;
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      plans_[k].own = plans_[k].ids.size();
      plans_[k].equations_so_far = equations += plans_[k].own - variables[k];
    }
    const std::size_t border = plans_.size() - 1;
    const auto border_ids = plans_[border].ids;
    for (std::size_t k = 0; k < border; ++k) {
      auto& ids = plans_[k].ids;
      if (k + 1 < border) {
        const auto& next = plans_[k + 1].ids;
        ids.insert(ids.end(), next.begin(),
                   next.begin() + static_cast<std::ptrdiff_t>(variables[k + 1]));
      }
      ids.insert(ids.end(), border_ids.begin(), border_ids.end());
    }
  }

  void add(std::vector<FrontPlan::Term> FrontPlan::*list, std::size_t source, std::size_t a,
           std::size_t b) {
    const auto left_out = [&](std::size_t id) { return id < p_.variables && p_.fixed[id]; };
    if (left_out(a) || left_out(b)) return;
    const auto [first, last] = std::minmax(front_[a], front_[b]);
    const std::size_t border = plans_.size() - 1;
    // Of the next stage, a front knows the variables, but not the multipliers.
    const bool multiplier_ahead =
        (front_[a] > first && a >= p_.variables) || (front_[b] > first && b >= p_.variables);
    if (last != first && last != border && (last != first + 1 || multiplier_ahead))
      throw Error("kkt: an entry couples stages " + std::to_string(front_[a]) + " and " +
                  std::to_string(front_[b]) +
                  "; it may couple a row's stage with itself and the next one");
    (plans_[first].*list).push_back({narrow(source), narrow(a), narrow(b)});
  }

  const Pattern& p_;
  std::vector<std::size_t> front_;
  std::vector<FrontPlan> plans_;
};

}  // namespace

std::vector<FrontPlan> plan_chain(const Pattern& p) {
  std::vector<std::size_t> front(p.variable_stage.begin(), p.variable_stage.end());
  front.insert(front.end(), p.equation_stage.begin(), p.equation_stage.end());
  return Planner(p, std::move(front), p.stages + 1).run();
}

std::vector<FrontPlan> plan_whole(const Pattern& p) {
  return Planner(p, std::vector<std::size_t>(p.variables + p.equations, 0), 1).run();
}

}  // namespace slalom::kkt
