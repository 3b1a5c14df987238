#include "assembly.hpp"

#include <algorithm>

namespace slalom::kkt {
namespace {

std::uint32_t narrow(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

/// The first front with an entry of each id.
std::vector<std::size_t> first_touch(const Pattern& p, const std::vector<std::size_t>& front) {
  std::vector<std::size_t> first = front;
  const auto couple = [&](std::size_t a, std::size_t b) {
    const std::size_t at = std::min(front[a], front[b]);
    first[a] = std::min(first[a], at);
    first[b] = std::min(first[b], at);
  };
  for (const auto& place : p.hessian)
    if (!p.fixed[place.row] && !p.fixed[place.col]) couple(place.row, place.col);
  for (const auto& entry : p.jacobian)
    if (!p.fixed[entry.variable]) couple(p.variables + entry.equation, entry.variable);
  return first;
}

/// Appends to each front what it touches of later ones, and what those before it handed on: from
/// the first front with an entry of it, an id goes along to its own.
void carry(const std::vector<std::size_t>& first, std::vector<FrontPlan>& plans) {
  for (std::size_t k = 0; k < plans.size(); ++k)
    for (std::size_t i = 0; i < plans[k].own; ++i)
      for (std::size_t to = first[plans[k].ids[i]]; to < k; ++to)
        plans[to].ids.push_back(plans[k].ids[i]);
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
  for (std::size_t i = 0; i < p.variables; ++i)
    if (!p.fixed[i]) plans[front[i]].ids.push_back(narrow(i));
  for (std::size_t e = 0; e < p.equations; ++e)
    plans[front[p.variables + e]].ids.push_back(narrow(p.variables + e));
  const auto first = first_touch(p, front);
  std::vector<std::size_t> reached(plans.size(), 0);
  for (std::size_t e = 0; e < p.equations; ++e) ++reached[first[p.variables + e]];
  std::size_t equations = 0;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    plans[k].own = plans[k].ids.size();
    plans[k].equations_so_far = equations += reached[k];
    if (k < p.stages) plans[k].parent = k + 1;
  }
  carry(first, plans);
  distribute(p, front, plans);
  return plans;
}

}  // namespace slalom::kkt
