#include "unwind.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slalom::ocp {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// Of what a row or the objective is, at most, when they are the same but for the sine's rounding.
constexpr double kRounding = 1e-9;

/// Full turns to add to each point's value so that no neighbours are more than half a turn apart,
/// and their mean is the angle nearest to 0; empty where all are 0.
std::vector<double> turns(const std::vector<double>& values) {
  std::vector<double> result(values.size(), 0.0);
  double sum = values.empty() ? 0 : values.front();
  bool any = false;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double jump = std::round((values[k] - values[k - 1]) / kTurn);
    result[k] = result[k - 1] - jump;
    any = any || jump != 0;
    sum += values[k] + kTurn * result[k];
  }
  if (!any) return {};
  const double whole = std::round(sum / static_cast<double>(values.size()) / kTurn);
  for (double& each : result) each -= whole;
  return result;
}

bool says_the_same(Transcription& transcription, const std::vector<double>& a,
                   const std::vector<double>& b) {
  nlp::Evaluation at, beside;
  if (transcription.evaluate(a, 1, {}, {.values = true}, at) ||
      transcription.evaluate(b, 1, {}, {.values = true}, beside))
    return false;
  const auto same = [](double x, double y) {
    return std::fabs(x - y) <= kRounding * std::max(1.0, std::fabs(x));
  };
  return same(at.objective, beside.objective) &&
         std::equal(at.rows.begin(), at.rows.end(), beside.rows.begin(), beside.rows.end(), same);
}

}  // namespace

bool unwind(const Problem& problem, Transcription& transcription, std::vector<double>& x) {
  const Trajectory wound = transcription.trajectory(x);
  const auto& scale = transcription.structure().variable_scale;
  bool any = false;
  for (std::size_t i = 0; i < problem.controls().size(); ++i) {
    std::vector<double> values;
    for (const auto& controls : wound.controls) values.push_back(controls[i]);
    const std::vector<double> added = turns(values);
    if (added.empty()) continue;
    Trajectory from = wound, to = wound;
    const Bounds bounds = problem.controls()[i].bounds;
    bool within = true;
    for (std::size_t k = 0; k < values.size(); ++k) {
      from.controls[k][i] = 0;
      to.controls[k][i] = added[k];
      const double value = values[k] + kTurn * added[k];
      within = within && value >= bounds.lower && value <= bounds.upper;
    }
    if (!within) continue;
    const std::vector<double> before = transcription.point(from), after = transcription.point(to);
    std::vector<double> unwound = x;
    for (std::size_t v = 0; v < x.size(); ++v)
      unwound[v] += kTurn * std::round((after[v] - before[v]) * scale[v]) / scale[v];
    if (!says_the_same(transcription, x, unwound)) continue;
    x = std::move(unwound);
    any = true;
  }
  return any;
}

}  // namespace slalom::ocp
