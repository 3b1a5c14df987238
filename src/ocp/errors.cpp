#include "slalom/ocp/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "integrator.hpp"
#include "model.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/interpolant.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

/// Integrates a problem's dynamics over one interval after another.
class Reintegration {
 public:
  Reintegration(const Problem& problem, const Trajectory& trajectory, const Interpolant& between,
                const Mesh& mesh, const Vector& units, double tolerance)
      : model_(problem, trajectory),
        integrator_(units, tolerance),
        trajectory_(trajectory),
        between_(between),
        breaks_(mesh.breakpoints()) {}

  /// The states at the end of interval k, from `x` at its begin; empty where there is no getting
  /// there.
  Vector across(std::size_t k, Vector x) const {
    const double duration = (breaks_[k + 1] - breaks_[k]) * (trajectory_.tf - trajectory_.t0);
    const double begin = trajectory_.time_at(breaks_[k]);
    const auto rates = [&](double c, const Vector& at, Vector& out) {
      model_.rates(begin + c * duration, at, between_.controls(k, c), out);
    };
    if (integrator_.across(duration, rates, x) < 1) return {};
    return x;
  }

 private:
  Model model_;
  Integrator integrator_;
  const Trajectory& trajectory_;
  const Interpolant& between_;
  const Vector& breaks_;
};

/// Relative error of `found` and the state with the largest.
std::pair<double, std::size_t> error_of(const Vector& found, const Vector& expected,
                                        const Vector& size) {
  if (found.empty()) return {kInfinity, 0};
  std::pair<double, std::size_t> worst{0, 0};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double error = std::fabs(found[i] - expected[i]) / size[i];
    if (error > worst.first) worst = {error, i};
  }
  return worst;
}

Interpolant between(const Problem& problem, const Solution& solution) {
  return {problem, solution.trajectory, solution.mesh, solution.scheme};
}

/// The scales the states were solved with; of a solution put together by hand the problem's.
Vector state_units(const Problem& problem, const Solution& solution) {
  Vector units = solution.state_units;
  if (units.empty())
    for (const auto& state : problem.states()) units.push_back(state.unit());
  return units;
}

/// The point of each mesh node.
std::vector<std::size_t> nodes(const Solution& solution) {
  std::vector<std::size_t> list{0};
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k)
    list.push_back(list.back() + solution.scheme.of(k).points.size() - 1);
  return list;
}

}  // namespace

ErrorEstimate estimate_errors(const Problem& problem, const Solution& solution, double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    throw InvalidValue(problem.name() + ": integrator's tolerance", fmt::format("{}", tolerance),
                       "a number > 0 and < 1");
  const Trajectory& trajectory = solution.trajectory;
  const Interpolant polynomials = between(problem, solution);
  const Vector units = state_units(problem, solution);
  const Reintegration integrator(problem, trajectory, polynomials, solution.mesh, units, tolerance);
  Vector size;
  for (std::size_t i = 0; i < problem.states().size(); ++i) {
    double largest = 0;
    for (const auto& x : trajectory.states) largest = std::max(largest, std::fabs(x[i]));
    size.push_back(units[i] + largest);
  }
  ErrorEstimate estimate;
  const auto node = nodes(solution);
  Vector running = trajectory.states.front();
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k) {
    const Vector& expected = trajectory.states[node[k + 1]];
    const auto [error, state] =
        error_of(integrator.across(k, trajectory.states[node[k]]), expected, size);
    estimate.interval.push_back(error);
    estimate.state.push_back(problem.states()[state].name);
    if (error > estimate.largest) {
      estimate.largest = error;
      estimate.worst = k;
    }
    if (!running.empty()) running = integrator.across(k, running);
    estimate.horizon = std::max(estimate.horizon, error_of(running, expected, size).first);
  }
  const double sum = std::accumulate(estimate.interval.begin(), estimate.interval.end(), 0.0);
  estimate.amplification = sum > 0 && std::isfinite(sum) ? estimate.horizon / sum : 0;
  return estimate;
}

Violation largest_violation(const Problem& problem, const Solution& solution, int samples) {
  if (samples < 1)
    throw InvalidValue(problem.name() + ": samples", std::to_string(samples), "at least 1");
  const Trajectory& trajectory = solution.trajectory;
  const Interpolant polynomials = between(problem, solution);
  const Model model(problem, trajectory);
  const auto& breaks = solution.mesh.breakpoints();
  Vector values(model.rows().size());
  Violation worst;
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k)
    for (int s = 0; s <= samples; ++s) {
      const double c = static_cast<double>(s) / samples;
      const double t = trajectory.time_at(breaks[k] + c * (breaks[k + 1] - breaks[k]));
      model.row_values(t, polynomials.states(k, c), polynomials.controls(k, c), values);
      for (std::size_t r = 0; r < values.size(); ++r) {
        const auto& row = model.rows()[r];
        if (k == 0 && s == 0 && row.points == Points::after_first) continue;
        const double excess = std::max(row.bounds.lower - values[r], values[r] - row.bounds.upper);
        if (excess > worst.value) worst = {excess, row.name, t};
      }
    }
  return worst;
}

std::vector<double> hamiltonian(const Problem& problem, const Solution& solution) {
  const Trajectory& trajectory = solution.trajectory;
  const Interpolant polynomials = between(problem, solution);
  const Model model(problem, trajectory);
  const auto node = nodes(solution);
  const std::size_t last = solution.mesh.intervals();
  Vector rates(problem.states().size()), values;
  for (std::size_t k = 0; k <= last; ++k) {
    const double t = trajectory.time(node[k]);
    const Vector u = k == last ? polynomials.controls(last - 1, 1) : polynomials.controls(k, 0);
    model.rates(t, trajectory.states[node[k]], u, rates);
    double h = model.integrand(t, trajectory.states[node[k]], u);
    for (std::size_t i = 0; i < rates.size(); ++i) h += solution.costates[k][i] * rates[i];
    values.push_back(h);
  }
  return values;
}

}  // namespace slalom::ocp
