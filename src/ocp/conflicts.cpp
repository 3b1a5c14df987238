#include "conflicts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace slalom::ocp {
namespace {

/// Of the first one's relative change: what must give more than so many times as much is no cause.
constexpr double kMostTimes = 1e3;

struct Candidate {
  Conflict conflict;
  double relative;  ///< size of the change in the constraint's own scale
};

/// Those of one constraint or bound, whose violation falls by `up` and `down` of itself for each
/// unit by which its upper bounds are raised, its lower ones lowered.
void add(const std::string& name, double up, double down, double unit,
         std::vector<Candidate>& list) {
  if (up * unit > 0) list.push_back({{name, 1 / up}, 1 / (up * unit)});
  if (down * unit > 0) list.push_back({{name, -1 / down}, 1 / (down * unit)});
}

void add(const std::string& name, const std::vector<double>& values, double unit,
         std::vector<Candidate>& list) {
  double up = 0, down = 0;
  for (const double value : values) {
    up += std::max(value, 0.0);
    down += std::max(-value, 0.0);
  }
  add(name, up, down, unit, list);
}

double unit_of(const Problem& problem, const std::string& name) {
  double unit = 1;
  const auto look = [&](const auto& list) {
    for (const auto& each : list)
      if (each.name == name) unit = each.unit();
  };
  look(problem.states());
  look(problem.controls());
  look(problem.static_parameters());
  look(problem.slacks());
  look(problem.integrals());
  look(std::vector{problem.t0(), problem.tf()});
  for (const auto& row : problem.constraints())
    if (name == row.name || name.starts_with(row.name + "[")) unit = row.unit();
  return unit;
}

std::vector<Candidate> candidates(const Problem& problem,
                                  const std::vector<Multipliers>& multipliers) {
  std::vector<Candidate> list;
  for (const auto& each : multipliers) {
    const double unit = unit_of(problem, each.name);
    std::vector<double> values = each.values;
    for (const auto& state : problem.states()) {
      if (state.name != each.name || values.empty()) continue;
      const auto take = [&](const char* end, Bounds bounds, double& value) {
        if (bounds.bounded()) add(end + state.name, {std::exchange(value, 0.0)}, unit, list);
      };
      take("initial ", state.initial, values.front());
      take("final ", state.final, values.back());
    }
    add(each.name, values, unit, list);
  }
  return list;
}

/// Of what is held along the horizon, for want of multipliers: dynamics leave it no freedom, or
/// others do.
void add_path_equations(const Problem& problem, const std::string& prefix,
                        std::vector<Conflict>& list) {
  for (const auto& row : problem.constraints())
    if (row.enabled && row.over_time() && row.bounds.lower == row.bounds.upper)
      list.push_back({prefix + row.name, 0});
}

std::vector<Conflict> in_order(std::vector<Candidate> list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const Candidate& a, const Candidate& b) { return a.relative < b.relative; });
  std::vector<Conflict> result;
  for (const auto& each : list)
    if (each.relative <= kMostTimes * list.front().relative) result.push_back(each.conflict);
  return result;
}

}  // namespace

std::vector<Conflict> conflicts(const Problem& problem,
                                const std::vector<Multipliers>& multipliers) {
  auto list = in_order(candidates(problem, multipliers));
  if (list.empty()) add_path_equations(problem, "", list);
  return list;
}

std::vector<Conflict> conflicts(const PhasedProblem& problem, const PhasedSolution& solution) {
  std::vector<Candidate> list;
  for (std::size_t p = 0; p < solution.phases.size(); ++p)
    for (auto& each : candidates(problem.phases()[p], solution.phases[p].multipliers)) {
      each.conflict.name = problem.phases()[p].name() + ": " + each.conflict.name;
      list.push_back(std::move(each));
    }
  for (const auto& [name, value] : solution.link_multipliers)
    add(name, std::max(value, 0.0), std::max(-value, 0.0), 1, list);
  auto result = in_order(std::move(list));
  if (result.empty())
    for (const auto& phase : problem.phases())
      add_path_equations(phase, phase.name() + ": ", result);
  return result;
}

std::vector<HighIndex> high_index(const Problem& problem) {
  const auto& states = problem.states();
  const auto meets_control = [&](const std::vector<Expr>& symbols) {
    return std::any_of(problem.controls().begin(), problem.controls().end(), [&](const auto& u) {
      return std::any_of(symbols.begin(), symbols.end(),
                         [&](const Expr& symbol) { return symbol.same(u.symbol); });
    });
  };
  std::vector<HighIndex> list;
  for (const auto& row : problem.constraints()) {
    if (!row.enabled || row.soft || row.kind != Problem::Kind::path ||
        row.bounds.lower != row.bounds.upper)
      continue;
    auto symbols = expr::symbols_of({row.value});
    int index = 1;
    while (!meets_control(symbols) && index <= static_cast<int>(states.size())) {
      std::vector<Expr> rates;
      for (const auto& state : states)
        for (const Expr& symbol : symbols)
          if (symbol.same(state.symbol)) rates.push_back(state.rate);
      symbols = expr::symbols_of(rates);
      ++index;
    }
    if (index >= 3 && meets_control(symbols)) list.push_back({row.name, index});
  }
  return list;
}

}  // namespace slalom::ocp
