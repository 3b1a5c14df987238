#include "assembly.hpp"

#include <algorithm>

#include "slalom/base/error.hpp"

namespace slalom::kkt {
namespace {

std::uint32_t narrow(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

/// Throws unless a front knows both ids of an entry: of the next stage, it knows the variables, but
/// not the multipliers.
void check_coupling(const Pattern& p, const std::vector<std::size_t>& front, std::size_t a,
                    std::size_t b) {
  const auto [first, last] = std::minmax(front[a], front[b]);
  const bool multiplier_ahead =
      (front[a] > first && a >= p.variables) || (front[b] > first && b >= p.variables);
  if (last != first && last != p.stages && (last != first + 1 || multiplier_ahead))
    throw Error("kkt: an entry couples stages " + std::to_string(front[a]) + " and " +
                std::to_string(front[b]) +
                "; it may couple a row's stage with itself and the next one");
}

}  // namespace

void distribute(const Pattern& p, const std::vector<std::size_t>& front_of,
                std::vector<FrontPlan>& plans) {
  const auto left_out = [&](std::size_t id) { return id < p.variables && p.fixed[id]; };
  const auto add = [&](std::vector<FrontPlan::Term> FrontPlan::*list, std::size_t source,
                       std::size_t a, std::size_t b) {
    if (left_out(a) || left_out(b)) return;
    auto& plan = plans[std::min(front_of[a], front_of[b])];
    (plan.*list).push_back({narrow(source), narrow(a), narrow(b)});
  };
  for (std::size_t e = 0; e < p.hessian.size(); ++e)
    add(&FrontPlan::hessian, e, p.hessian[e].row, p.hessian[e].col);
  for (std::size_t i = 0; i < p.variables; ++i) add(&FrontPlan::diagonal, i, i, i);
  for (const auto& entry : p.jacobian)
    add(&FrontPlan::jacobian, entry.source, p.variables + entry.equation, entry.variable);
  for (std::size_t e = 0; e < p.equations; ++e)
    add(&FrontPlan::flexibility, e, p.variables + e, p.variables + e);
}

std::vector<FrontPlan> plan_chain(const Pattern& p) {
  std::vector<std::size_t> front(p.variable_stage.begin(), p.variable_stage.end());
  front.insert(front.end(), p.equation_stage.begin(), p.equation_stage.end());
  std::vector<FrontPlan> plans(p.stages + 1);
  std::vector<std::size_t> variables;
  for (std::size_t i = 0; i < p.variables; ++i)
    if (!p.fixed[i]) plans[front[i]].ids.push_back(narrow(i));
  for (auto& plan : plans) variables.push_back(plan.ids.size());
  for (std::size_t e = 0; e < p.equations; ++e)
    plans[front[p.variables + e]].ids.push_back(narrow(p.variables + e));
  std::size_t equations = 0;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    plans[k].own = plans[k].ids.size();
    plans[k].equations_so_far = equations += plans[k].own - variables[k];
    if (k < p.stages) plans[k].parent = k + 1;
  }
  const auto border = plans.back().ids;
  for (std::size_t k = 0; k < p.stages; ++k) {
    auto& ids = plans[k].ids;
    if (k + 1 < p.stages) {
      const auto& next = plans[k + 1].ids;
      ids.insert(ids.end(), next.begin(),
                 next.begin() + static_cast<std::ptrdiff_t>(variables[k + 1]));
    }
    ids.insert(ids.end(), border.begin(), border.end());
  }
  for (const auto& place : p.hessian)
    if (!p.fixed[place.row] && !p.fixed[place.col]) check_coupling(p, front, place.row, place.col);
  for (const auto& entry : p.jacobian)
    if (!p.fixed[entry.variable])
      check_coupling(p, front, p.variables + entry.equation, entry.variable);
  distribute(p, front, plans);
  return plans;
}

}  // namespace slalom::kkt
