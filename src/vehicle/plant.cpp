#include "slalom/vehicle/plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_fehlberg78.hpp>
#include <boost/numeric/odeint/stepper/generation/make_controlled.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>

#include "../base/extrapolated_euler.hpp"
#include "../base/integrate.hpp"

namespace slalom::vehicle {
namespace {

namespace odeint = boost::numeric::odeint;

/// Knots nearer than this to another instant are no instants of their own [s].
constexpr double kSameInstant = 1e-7;

using Method = odeint::runge_kutta_fehlberg78<State>;
/// Copied for every integration; static, so that its scratch arrays start as zeros.
const Method kMethod;
/// Slower than this the tyres' lateral response, at a rate of about C / (m ux), is stiff [m/s].
constexpr double kStiff = 1;

/// x' while the control goes linearly from one to another over a length of time, from t = 0 on.
struct Driven {
  const Dynamics& dynamics;
  const Control &first, &last;
  double length;

  Control control(double t) const {
    Control result;
    for (std::size_t i = 0; i < kControls; ++i)
      result[i] = first[i] + (last[i] - first[i]) * (t / length);
    return result;
  }
  void operator()(const State& x, State& dxdt, double t) const {
    dxdt = dynamics.derivative(x, control(t));
  }
  Square<kStates> jacobian(const State& x, double t) const {
    return dynamics.jacobian(x, control(t));
  }
};

}  // namespace

Plant::Plant(const Parameters& vehicle, double tolerance, double sample_step)
    : dynamics_(vehicle), tolerance_(tolerance), sample_step_(sample_step) {}

State Plant::advance(const State& state, const ControlSignal& signal, double t0, double t1) const {
  return advance(state, signal.at(t0), signal.at(t1), t0, t1);
}

State Plant::advance(const State& state, const Control& first, const Control& last, double t0,
                     double t1) const {
  const double length = t1 - t0;
  if (!(length > 0)) return state;
  const Driven rhs{dynamics_, first, last, length};
  State x = state;
  x[X] = x[Y] = 0;
  double t = 0;
  const bool there = state[UX] < kStiff
                         ? integrate(ExtrapolatedEuler<kStates>(tolerance_), rhs, length, 0, x, t)
                         : integrate(odeint::make_controlled(tolerance_, tolerance_, kMethod), rhs,
                                     length, 0, x, t);
  if (there) {
    x[X] += state[X];
    x[Y] += state[Y];
    return x;
  }
  throw PlantError(fmt::format(
      "the plant cannot be integrated past t = {:.9g} s (ux = {:.6g} m/s, ax = {:.6g} m/s^2)",
      t0 + t, x[UX], x[AX]));
}

std::vector<double> Plant::instants(const ControlSignal& signal, double t0, double t1) const {
  std::vector<double> corners;
  const double end = t1 - t0 > 10 * kSwapGap ? t1 - kSwapGap : t1;
  for (const double knot : signal.knots())
    if (knot > (corners.empty() ? t0 : corners.back()) + kSameInstant && knot < end - kSameInstant)
      corners.push_back(knot);
  corners.push_back(end);
  if (end < t1) corners.push_back(t1);

  std::vector<double> result;
  double from = t0;
  for (const double to : corners) {
    const auto pieces = std::max(1., std::ceil((to - from) / sample_step_ - 1e-9));
    for (double i = 1; i < pieces; ++i) result.push_back(from + (to - from) * (i / pieces));
    result.push_back(to);
    from = to;
  }
  return result;
}

State Plant::predict(State state, const ControlSignal& signal, double t0, double t1) const {
  for (const double t : instants(signal, t0, t1)) {
    state = advance(state, signal, t0, t);
    t0 = t;
  }
  return state;
}

}  // namespace slalom::vehicle
