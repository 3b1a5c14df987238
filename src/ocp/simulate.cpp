#include "slalom/ocp/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "integrator.hpp"
#include "point_functions.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/interpolant.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

/// The controls within one stretch between corners: a jump at either end belongs to its neighbour.
class WithinStretch {
 public:
  WithinStretch(const System& system, const Controls& controls, double begin, double end)
      : system_(system), controls_(controls) {
    const double ulp =
        8 * std::max(std::fabs(begin), std::fabs(end)) * std::numeric_limits<double>::epsilon();
    const double inside = std::min(std::max(1e-12 * (end - begin), ulp), (end - begin) / 2);
    begin_ = begin + inside;
    end_ = end - inside;
  }

  Vector operator()(double t, std::span<const double> x) const {
    Vector u = controls_.law(std::clamp(t, begin_, end_), x);
    if (u.size() != system_.controls.size())
      throw InvalidValue(system_.name + ": simulation",
                         fmt::format("{} controls at t = {}", u.size(), t),
                         fmt::format("{}", system_.controls.size()));
    return u;
  }

 private:
  const System& system_;
  const Controls& controls_;
  double begin_, end_;
};

void check(const System& system, const Vector& x0, const Controls& controls, double t0, double tf,
           const SimulateSettings& settings) {
  const std::string where = system.name + ": simulation";
  if (!system.rates || !controls.law)
    throw InvalidValue(where, system.rates ? "no controls" : "no rates", "a function");
  if (x0.size() != system.states.size())
    throw InvalidValue(where, fmt::format("{} initial states", x0.size()),
                       fmt::format("{}", system.states.size()));
  if (!system.scales.empty() && system.scales.size() != system.states.size())
    throw InvalidValue(where, fmt::format("{} scales", system.scales.size()),
                       fmt::format("{}, one for each state, or none", system.states.size()));
  for (std::size_t i = 0; i < x0.size(); ++i)
    if (!std::isfinite(x0[i]))
      throw InvalidValue(where, fmt::format("initial {} = {}", system.states[i], x0[i]),
                         "a finite number");
  if (!(std::isfinite(t0) && std::isfinite(tf) && t0 <= tf))
    throw InvalidValue(where, fmt::format("t0 = {}, tf = {}", t0, tf), "finite t0 <= tf");
  if (settings.steps < 1)
    throw InvalidValue(where, fmt::format("{} steps", settings.steps), "at least 1");
  if (!(settings.tolerance > 0 && settings.tolerance < 1))
    throw InvalidValue(where, fmt::format("tolerance {}", settings.tolerance),
                       "a number > 0 and < 1");
}

/// Equal steps from t0 to tf, and the corners in between.
Vector instants(double t0, double tf, int steps, const Vector& corners) {
  Vector times;
  for (int k = 0; k <= steps; ++k) times.push_back(t0 + (tf - t0) * k / steps);
  times.back() = tf;
  for (const double corner : corners)
    if (corner > t0 && corner < tf) times.push_back(corner);
  std::sort(times.begin(), times.end());
  // Nearer to each other than this they are one: the integrator's time would not move.
  const double same = 1e-12 * (tf - t0);
  const auto last =
      std::unique(times.begin(), times.end(), [same](double a, double b) { return b - a <= same; });
  times.erase(last, times.end());
  times.back() = tf;
  return times;
}

/// Thrown through the integrator where a simulation is to end.
struct Stopped {};

std::string lost(const System& system, double t, const Vector& x) {
  std::string values;
  for (std::size_t i = 0; i < x.size(); ++i)
    values += fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", system.states[i], x[i]);
  return fmt::format("{} cannot be integrated past t = {:.9g} ({})", system.name, t, values);
}

void set_times(Trajectory& trajectory, const Vector& times) {
  trajectory.t0 = times.front();
  trajectory.tf = times.back();
  const double span = trajectory.tf - trajectory.t0;
  for (const double t : times) trajectory.tau.push_back(span > 0 ? (t - times.front()) / span : 0);
}

}  // namespace

System system_of(const Problem& problem, const Trajectory& fixed) {
  const std::string where = problem.name() + ": simulation";
  System system{problem.name(), {}, {}, {}, scales_of(problem)};
  std::vector<Expr> rates;
  for (const auto& state : problem.states()) {
    if (!state.has_rate)
      throw InvalidValue(where, "no dynamics of " + state.name,
                         "a call of dynamics for each state");
    system.states.push_back(state.name);
    rates.push_back(state.rate);
  }
  for (const auto& control : problem.controls()) system.controls.push_back(control.name);
  for (const auto& symbol : expr::symbols_of(rates))
    for (const auto& state : problem.states())
      if (symbol.same(state.final_symbol))
        throw InvalidValue(where, "dynamics that use " + symbol.name(),
                           "dynamics that a simulation can know");
  Trajectory at = fixed;
  if (at.states.empty()) at.states.assign(1, Vector(problem.states().size(), 0.0));
  const auto functions = std::make_shared<const PointFunctions>(problem, at);
  system.rates = [functions](double t, std::span<const double> x, std::span<const double> u,
                             std::span<double> out) { functions->rates(t, x, u, out); };
  return system;
}

Controls constant_controls(std::vector<double> values) {
  return {[values = std::move(values)](double, std::span<const double>) { return values; }};
}

Controls controls_of_time(std::function<std::vector<double>(double t)> law,
                          std::vector<double> corners) {
  return {[law = std::move(law)](double t, std::span<const double>) { return law(t); },
          std::move(corners)};
}

Controls controls_of(const Problem& problem, const Solution& solution) {
  const auto between = std::make_shared<const Interpolant>(problem, solution.trajectory,
                                                           solution.mesh, solution.scheme);
  Vector corners;
  for (const double tau : solution.mesh.breakpoints())
    corners.push_back(solution.trajectory.time_at(tau));
  return {[between](double t, std::span<const double>) { return between->controls(t); },
          std::move(corners)};
}

Simulation simulate(const System& system, const std::vector<double>& x0, const Controls& controls,
                    const SimulateSettings& settings) {
  const double t0 = settings.t0.value_or(0), tf = settings.tf.value_or(1);
  check(system, x0, controls, t0, tf, settings);
  const Integrator integrator(system.scales.empty() ? Vector(x0.size(), 1.0) : system.scales,
                              settings.tolerance);
  const Vector times = instants(t0, tf, settings.steps, controls.corners);
  Simulation result{{}, true, {}};
  Vector reached{t0}, x = x0;
  for (std::size_t k = 0; k + 1 < times.size() && result.complete; ++k) {
    const double begin = times[k], duration = times[k + 1] - begin;
    const WithinStretch law(system, controls, begin, times[k + 1]);
    result.trajectory.states.push_back(x);
    result.trajectory.controls.push_back(law(begin, x));
    const auto rates = [&](double c, const Vector& at, Vector& out) {
      if (settings.stop && settings.stop()) throw Stopped{};
      const double t = begin + c * duration;
      system.rates(t, at, law(t, at), out);
    };
    double share = 0;
    const Vector before = x;
    try {
      share = integrator.across(duration, rates, x);
      if (share != 1) result.message = lost(system, begin + share * duration, x);
    } catch (const Stopped&) {
      x = before;
      result.message = fmt::format("{} was stopped after t = {:.9g}", system.name, begin);
    }
    result.complete = share == 1;
    if (result.complete || share > 0) reached.push_back(begin + share * duration);
  }
  if (result.trajectory.states.size() < reached.size()) {
    result.trajectory.states.push_back(x);
    const double begin = reached.size() > 1 ? reached[reached.size() - 2] : t0;
    result.trajectory.controls.push_back(
        WithinStretch(system, controls, begin, reached.back())(reached.back(), x));
  }
  set_times(result.trajectory, reached);
  return result;
}

Simulation simulate(const Problem& problem, const std::vector<double>& x0, const Controls& controls,
                    const SimulateSettings& settings) {
  SimulateSettings own = settings;
  own.t0 = settings.t0.value_or(problem.t0().guess);
  own.tf = settings.tf.value_or(problem.tf().guess);
  Trajectory fixed;
  fixed.t0 = *own.t0;
  fixed.tf = *own.tf;
  if (x0.size() == problem.states().size()) fixed.states = {x0};
  Simulation result = simulate(system_of(problem, fixed), x0, controls, own);
  for (const auto& parameter : problem.static_parameters())
    result.trajectory.static_parameters.push_back(parameter.guess);
  return result;
}

}  // namespace slalom::ocp
