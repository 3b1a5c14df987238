#include "slalom/ocp/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

#include "bound_shares.hpp"
#include "integrator.hpp"
#include "point_functions.hpp"
#include "set_up_watch.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "solution_points.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

/// Integrates a problem's dynamics, its cost's integrand and its integrals' over one interval after
/// another.
class Reintegration {
 public:
  Reintegration(const Problem& problem, const Solution& solution, const Interpolant& between,
                const Vector& units, double tolerance)
      : problem_(problem),
        solution_(solution),
        functions_(problem, solution.trajectory),
        integrator_(units, tolerance),
        between_(between),
        nodes_(node_points(solution)) {}

  /// States and integrals at the end of interval k, from those at its begin; empty where there is
  /// no getting there.
  Vector across(std::size_t k, Vector x) const {
    const auto [begin, duration] = stretch(k);
    const std::size_t nx = problem_.states().size();
    const auto rates = [&, begin = begin, duration = duration](double c, const Vector& at,
                                                               Vector& out) {
      const Vector u = between_.controls(k, c);
      const std::span<const double> states(at.data(), nx);
      functions_.rates(begin + c * duration, states, u, {out.data(), nx});
      functions_.integrands(begin + c * duration, states, u,
                            {out.data() + nx, functions_.integrands()});
    };
    if (integrator_.across(duration, rates, x) < 1) return {};
    return x;
  }

  /// The scheme's own quadrature of the integrands over interval k; with their sizes' instead.
  Vector quadrature(std::size_t k, bool of_sizes) const {
    const auto [begin, duration] = stretch(k);
    const Scheme& scheme = solution_.scheme.of(k);
    const std::size_t first = nodes_[k], last = scheme.points.size() - 1;
    const Trajectory& at = solution_.trajectory;
    Vector sum(functions_.integrands(), 0.0), values(functions_.integrands());
    for (std::size_t j = 0; j <= last; ++j) {
      if (scheme.weight[j] == 0) continue;
      const bool held = j == last && scheme.collocates(0);
      const Vector u = held ? end_controls(problem_, at, first, first + j) : at.controls[first + j];
      functions_.integrands(begin + scheme.points[j] * duration, at.states[first + j], u, values);
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += scheme.weight[j] * duration * (of_sizes ? std::fabs(values[i]) : values[i]);
    }
    return sum;
  }

 private:
  std::pair<double, double> stretch(std::size_t k) const {
    const auto& breaks = solution_.mesh.breakpoints();
    const Trajectory& at = solution_.trajectory;
    return {at.time_at(breaks[k]), (breaks[k + 1] - breaks[k]) * (at.tf - at.t0)};
  }
  const Problem& problem_;
  const Solution& solution_;
  PointFunctions functions_;
  Integrator integrator_;
  const Interpolant& between_;
  std::vector<std::size_t> nodes_;
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

/// What an interval's errors make of the objective: those of the states by their costates at its
/// end, that of the cost's integral as it is.
double objective_share(const Solution& solution, std::size_t interval, const Vector& found,
                       const Vector& expected) {
  if (found.empty()) return kInfinity;
  if (interval + 1 >= solution.costates.size()) return 0;  // put together by hand, without
  const std::vector<double>& costates = solution.costates[interval + 1];
  double share = found[costates.size()] - expected[costates.size()];
  for (std::size_t i = 0; i < costates.size(); ++i) share += costates[i] * (found[i] - expected[i]);
  return share;
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

/// The objective where everything is moved by its own scale, by one point of it: the solver's unit
/// of an objective that is 0 at its least.
double objective_beside(const Problem& problem, const Solution& solution) {
  Trajectory at = solution.trajectory;
  const std::size_t nx = problem.states().size(), nu = problem.controls().size();
  if (solution.scales.size() < nx + nu) return 0;  // put together by hand
  for (std::size_t k = 0; k < at.tau.size(); ++k) {
    for (std::size_t i = 0; i < nx; ++i) at.states[k][i] += solution.scales[i].second;
    for (std::size_t i = 0; i < nu; ++i) at.controls[k][i] += solution.scales[nx + i].second;
  }
  Expr sum = 0;
  for (const auto& term : problem.costs())
    if (term.enabled) sum += term.lagrange ? (at.tf - at.t0) * term.value : term.value;
  const std::size_t middle = at.tau.size() / 2;
  Vector inputs = at.states[middle];
  inputs.insert(inputs.end(), at.controls[middle].begin(), at.controls[middle].end());
  inputs.push_back(at.time(middle));
  inputs.push_back(at.tau[middle]);
  double value = 0;
  function_along(problem, at, {sum})(inputs, {}, {&value, 1});
  return std::isfinite(value) ? std::fabs(value) : 0;
}

/// Of states, cost and integrals: names, solver's units, and what an error is relative to.
struct Sizes {
  std::vector<std::string> names;
  Vector units, sizes;
  double objective = 0;  ///< of it and all that adds up to its integral
};

Sizes sizes_of(const Problem& problem, const Solution& solution, const Interpolant& polynomials) {
  Sizes list;
  list.units = state_units(problem, solution);
  for (std::size_t i = 0; i < problem.states().size(); ++i) {
    double largest = 0;
    for (const auto& x : solution.trajectory.states) largest = std::max(largest, std::fabs(x[i]));
    list.names.push_back(problem.states()[i].name);
    list.sizes.push_back(list.units[i] + largest);
  }
  // An integral's size is that of all that adds up to it; the whole cost counts for the cost's.
  const Reintegration integrator(problem, solution, polynomials, list.units, 0.5);
  Vector integrals;
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k) {
    SetUpWatch::poll();
    const Vector part = integrator.quadrature(k, true);
    integrals.resize(part.size(), 0.0);
    for (std::size_t i = 0; i < part.size(); ++i) integrals[i] += part[i];
  }
  integrals.front() += std::fabs(solution.objective);
  list.objective =
      std::max(integrals.front(), solution.options.tol * objective_beside(problem, solution));
  list.names.emplace_back("the cost's integral");
  for (const auto& integral : problem.integrals()) list.names.push_back(integral.name);
  for (const double size : integrals) {
    list.sizes.push_back(size > 0 ? size : 1);
    list.units.push_back(size > 0 ? size : 1);
  }
  return list;
}

}  // namespace

ErrorEstimate estimate_errors(const Problem& problem, const Solution& solution, double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    throw InvalidValue(problem.name() + ": integrator's tolerance", fmt::format("{}", tolerance),
                       "a number > 0 and < 1");
  const Trajectory& trajectory = solution.trajectory;
  const Interpolant polynomials = between(problem, solution);
  const Sizes sizes = sizes_of(problem, solution, polynomials);
  const Reintegration integrator(problem, solution, polynomials, sizes.units, tolerance);
  const auto node = node_points(solution);
  const auto begin = [&](std::size_t k) {
    Vector x = trajectory.states[node[k]];
    x.resize(sizes.names.size(), 0.0);
    return x;
  };
  ErrorEstimate estimate;
  estimate.objective_size = sizes.objective;
  estimate.bound_share = bound_shares(problem, solution, polynomials);
  Vector running = begin(0);
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k) {
    SetUpWatch::ask_now();
    Vector expected = trajectory.states[node[k + 1]];
    for (const double integral : integrator.quadrature(k, false)) expected.push_back(integral);
    const Vector found = integrator.across(k, begin(k));
    const auto [error, which] = error_of(found, expected, sizes.sizes);
    estimate.objective_share.push_back(objective_share(solution, k, found, expected));
    estimate.objective += estimate.objective_share.back();
    estimate.interval.push_back(error);
    estimate.state.push_back(sizes.names[which]);
    if (error > estimate.largest) {
      estimate.largest = error;
      estimate.worst = k;
    }
    if (!running.empty()) {  // empty once the integration along the horizon has failed
      std::fill(running.begin() + static_cast<std::ptrdiff_t>(problem.states().size()),
                running.end(), 0.0);
      running = integrator.across(k, running);
    }
    const Vector states(running.begin(),
                        running.begin() + static_cast<std::ptrdiff_t>(
                                              running.empty() ? 0 : problem.states().size()));
    estimate.horizon = std::max(
        estimate.horizon, error_of(states, trajectory.states[node[k + 1]], sizes.sizes).first);
  }
  const double sum = std::accumulate(estimate.interval.begin(), estimate.interval.end(), 0.0);
  estimate.amplification = sum > 0 && std::isfinite(sum) ? estimate.horizon / sum : 0;
  return estimate;
}

namespace {

/// Of a control's largest size: a range below counts as this. What the barrier keeps a control off
/// its bound is no jump, however it compares with the rest of such a control.
constexpr double kLeastRange = 0.1;
/// Of a control's scale: what the solver may take for 0.
constexpr double kSolversZero = 1e-6;

/// Value, slope and curvature of a control's polynomial at one end of an interval.
struct EndShape {
  double value, slope, curvature;

  /// `end`: 0 at the interval's begin, 1 at its end. By differences that a parabola meets exactly.
  EndShape(const Interpolant& polynomials, std::size_t control, std::size_t interval, double end,
           double length) {
    constexpr double kPart = 1e-3;
    const double step = end > 0 ? -kPart : kPart, h = step * length;
    const auto at = [&](double c) { return polynomials.controls(interval, c)[control]; };
    const double near = at(end + step), far = at(end + 2 * step);
    value = at(end);
    slope = (4 * near - far - 3 * value) / (2 * h);
    curvature = (far - 2 * near + value) / (h * h);
  }
};

/// Of a control's polynomial over a single interval, which has no neighbours: the larger of its
/// last two coefficients in Chebyshev's polynomials, which are small where it is resolved.
double tail_of(const Interpolant& polynomials, std::size_t control) {
  constexpr int kSamples = 24;
  Vector sample, coefficient;
  for (int s = 0; s < kSamples; ++s)
    sample.push_back(
        polynomials.controls(0, 0.5 - 0.5 * std::cos(M_PI * (s + 0.5) / kSamples))[control]);
  for (int n = 0; n < kSamples; ++n) {
    double sum = 0;
    for (int s = 0; s < kSamples; ++s) sum += sample[s] * std::cos(M_PI * n * (s + 0.5) / kSamples);
    coefficient.push_back(std::fabs(sum) * 2 / kSamples);
  }
  const double largest = *std::max_element(coefficient.begin() + 1, coefficient.end());
  int last = kSamples - 1;
  while (last > 1 && coefficient[last] <= 1e-10 * largest) --last;
  return std::max(coefficient[last], last > 1 ? coefficient[last - 1] : 0.0);
}

/// How far two polynomials that meet at a node are from one another a length `h` away from it, to
/// second order. Value and slope alone would not do: the parabola of an interval whose control
/// jumps at a third of it meets one neighbour with equal value and slope.
double gap_between(const EndShape& before, const EndShape& after, double h) {
  return std::fabs(after.value - before.value) + std::fabs(after.slope - before.slope) * h +
         std::fabs(after.curvature - before.curvature) * h * h / 6;
}

}  // namespace

std::vector<double> unresolved_controls(const Problem& problem, const Solution& solution) {
  const Interpolant polynomials = between(problem, solution);
  const auto& breaks = solution.mesh.breakpoints();
  const std::size_t intervals = solution.mesh.intervals(), nu = problem.controls().size();
  Vector unresolved(intervals, 0.0);
  for (std::size_t i = 0; i < nu; ++i) {
    const auto [low, high, unit] = control_range(problem, solution, i);
    const double largest = std::max(std::fabs(high), std::fabs(low));
    if (!(high - low > 2e-6 * largest)) continue;
    const double range = std::max({high - low, kLeastRange * largest, kSolversZero * unit});
    const auto length = [&](std::size_t k) { return breaks[k + 1] - breaks[k]; };
    if (intervals == 1) {
      unresolved[0] = std::max(unresolved[0], tail_of(polynomials, i) / range);
      continue;
    }
    Vector gap(intervals + 1, kInfinity);  // by node; none counts at the horizon's ends
    SetUpWatch::ask_now();
    for (std::size_t k = 1; k < intervals; ++k)
      gap[k] = gap_between(EndShape(polynomials, i, k - 1, 1, length(k - 1)),
                           EndShape(polynomials, i, k, 0, length(k)),
                           std::min(length(k - 1), length(k)));
    for (std::size_t k = 0; k < intervals; ++k)
      unresolved[k] =
          std::max(unresolved[k], length(k) * length(k) * std::min(gap[k], gap[k + 1]) / range);
  }
  return unresolved;
}

Violation largest_violation(const Problem& problem, const Solution& solution, int samples) {
  if (samples < 1)
    throw InvalidValue(problem.name() + ": samples", std::to_string(samples), "at least 1");
  const Trajectory& trajectory = solution.trajectory;
  const Interpolant polynomials = between(problem, solution);
  const PointFunctions functions(problem, trajectory);
  const auto& breaks = solution.mesh.breakpoints();
  Vector values(functions.rows().size());
  Violation worst;
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k)
    for (int s = 0; s <= samples; ++s) {
      const double c = static_cast<double>(s) / samples;
      const double t = trajectory.time_at(breaks[k] + c * (breaks[k + 1] - breaks[k]));
      functions.row_values(t, polynomials.states(k, c), polynomials.controls(k, c), values);
      for (std::size_t r = 0; r < values.size(); ++r) {
        const auto& row = functions.rows()[r];
        if (k == 0 && s == 0 && row.points == Points::after_first) continue;
        const double excess = std::max(row.bounds.lower - values[r], values[r] - row.bounds.upper);
        if (excess > worst.value) worst = {excess, row.name, t};
      }
    }
  return worst;
}

std::vector<double> hamiltonian(const Problem& problem, const Solution& solution) {
  const Trajectory& trajectory = solution.trajectory;
  if (solution.costates.empty())
    throw InvalidValue(problem.name() + ": Hamiltonian", "a solve that did not begin",
                       "an answer with costates");
  const Interpolant polynomials = between(problem, solution);
  const PointFunctions functions(problem, trajectory);
  const auto node = node_points(solution);
  const std::size_t last = solution.mesh.intervals();
  Vector rates(problem.states().size()), values;
  for (std::size_t k = 0; k <= last; ++k) {
    const double t = trajectory.time(node[k]);
    const Vector u = k == last ? polynomials.controls(last - 1, 1) : polynomials.controls(k, 0);
    functions.rates(t, trajectory.states[node[k]], u, rates);
    double h = functions.integrand(t, trajectory.states[node[k]], u);
    for (std::size_t i = 0; i < rates.size(); ++i) h += solution.costates[k][i] * rates[i];
    values.push_back(h);
  }
  return values;
}

}  // namespace slalom::ocp
