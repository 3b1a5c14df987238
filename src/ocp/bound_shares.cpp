#include "bound_shares.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "point_functions.hpp"
#include "set_up_watch.hpp"
#include "symbols.hpp"

namespace slalom::ocp {
namespace {

/// Of an interval: where bounds are looked at besides its points.
constexpr int kSamples = 12;

/// Each row's multipliers by point; none for a row that is not judged or holds nowhere.
std::vector<std::vector<double>> multipliers_of(const Problem& problem, const Solution& solution,
                                                const PointFunctions& functions) {
  std::unordered_map<std::string, const Multipliers*> known;
  for (const auto& each : solution.multipliers) known[each.name] = &each;
  // Where a control is bounded too, its polynomials' swings at a jump would count.
  const auto judged = rows_of_states(problem);
  std::vector<std::vector<double>> list;
  for (const auto& row : functions.known_rows()) {
    auto& values = list.emplace_back();
    const auto at = known.find(row.name);
    if (at == known.end() || std::find(judged.begin(), judged.end(), row.name) == judged.end() ||
        row.bounds.lower == row.bounds.upper)
      continue;
    const Multipliers& of = *at->second;
    if (std::none_of(of.values.begin(), of.values.end(), [](double y) { return y != 0; })) continue;
    values.resize(solution.trajectory.tau.size(), 0.0);
    for (std::size_t j = 0; j < of.points.size(); ++j) values[of.points[j]] = of.values[j];
  }
  return list;
}

}  // namespace

std::vector<std::string> rows_of_states(const Problem& problem) {
  std::vector<std::string> names;
  for (const auto& state : problem.states()) names.push_back(state.name);
  const Symbols symbols(problem);
  for (const auto& row : problem.constraints()) {
    if (!row.enabled || !row.over_time() || row.soft) continue;
    const auto used = expr::symbols_of({row.value});
    const bool of_controls = std::any_of(used.begin(), used.end(), [&](const Expr& symbol) {
      const Meaning* meaning = symbols.find(symbol);
      return meaning != nullptr && meaning->kind == Meaning::Kind::control;
    });
    if (of_controls) continue;
    if (row.kind == Problem::Kind::path) names.push_back(row.name);
    for (const auto& member : row.members) names.push_back(row.name + "[" + member + "]");
  }
  return names;
}

std::vector<double> bound_shares(const Problem& problem, const Solution& solution,
                                 const Interpolant& polynomials) {
  const std::size_t intervals = solution.mesh.intervals();
  std::vector<double> shares(intervals, 0.0);
  const PointFunctions functions(problem, solution.trajectory);
  const auto multipliers = multipliers_of(problem, solution, functions);
  if (std::all_of(multipliers.begin(), multipliers.end(), [](const auto& y) { return y.empty(); }))
    return shares;
  const auto& breaks = solution.mesh.breakpoints();
  std::vector<double> values(multipliers.size()), low(values.size()), high(values.size());
  for (std::size_t k = 0, first = 0; k < intervals; ++k) {
    SetUpWatch::ask_now();
    const std::size_t last = first + solution.scheme.of(k).points.size() - 1;
    std::fill(low.begin(), low.end(), 0.0);
    high = low;
    for (int s = 0; s < kSamples; ++s) {
      const double c = (s + 0.5) / kSamples;
      const double t = solution.trajectory.time_at(breaks[k] + c * (breaks[k + 1] - breaks[k]));
      functions.row_values(t, polynomials.states(k, c), polynomials.controls(k, c), values);
      for (std::size_t r = 0; r < values.size(); ++r) {
        low[r] = std::max(low[r], functions.known_rows()[r].bounds.lower - values[r]);
        high[r] = std::max(high[r], values[r] - functions.known_rows()[r].bounds.upper);
      }
    }
    for (std::size_t r = 0; r < values.size(); ++r)
      for (std::size_t j = first; j <= last && !multipliers[r].empty(); ++j)
        shares[k] += std::max({0.0, multipliers[r][j] * high[r], -multipliers[r][j] * low[r]});
    first = last;
  }
  return shares;
}

}  // namespace slalom::ocp
