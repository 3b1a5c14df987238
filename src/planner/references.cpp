#include "references.hpp"

#include <algorithm>
#include <cmath>

#include "slalom/vehicle/agility.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Knots of references are this far apart [s].
constexpr double kKnot = 0.05;
/// Accelerations of a way, which jump, are means over this many knots on each side.
constexpr std::ptrdiff_t kSmooth = 6;
/// A way's steering rates and jerks stay within this share of the limits, so that feedback has
/// room.
constexpr double kShare = 0.9;
/// Braking ends at this speed [m/s]; it settles there at this rate [1/s].
constexpr double kCreep = 0.12, kSpeedSpare = 0.1, kSettling = 1.2;
/// A body's braking ends so far above its least speed [m/s].
constexpr double kBodyCreep = 0.07;
/// Braking beyond a way's end [m/s^2], of the HMMWV.
constexpr double kBraking = 3;
constexpr double kLongestStop = 30;  ///< [s]
/// A swerve: each of its bends [s], its curvature [1/m] and lateral acceleration [m/s^2] at most,
/// of the HMMWV.
constexpr double kBend = 1, kSwerveCurvature = 0.1, kSwerveLateral = 3;

/// Cornering stiffnesses [N/rad] of the axles at their static loads.
struct Stiffness {
  double front, rear;
  explicit Stiffness(const Parameters& p)
      : front(p.cornering_stiffness(p.FzF0)), rear(p.cornering_stiffness(p.FzR0)) {}
};

/// Steady cornering of the front axle's centre at speed v along curvature kappa and heading theta.
State cornering(const world::WayPoint& w, const Parameters& p, const Stiffness& c) {
  const double L = p.la + p.lb, lateral = w.v * w.v * w.kappa;
  const double beta =
      w.kappa * L - p.m * p.la / L * lateral / c.rear;  // of the front axle's centre
  State x{};
  x[X] = w.x;
  x[Y] = w.y;
  x[PSI] = w.heading - beta;
  x[R] = w.v * w.kappa;
  x[V] = beta * w.v - p.la * x[R];
  x[SA] = beta + p.m * p.lb / L * lateral / c.front;
  x[UX] = w.v;
  x[AX] = std::clamp(w.a, p.ax_min_at(w.v), p.ax_max_at(w.v));
  return x;
}

/// In which the front axle's centre moves.
double direction(const State& x, const Parameters& p) {
  return x[PSI] + std::atan2(x[V] + p.la * x[R], std::max(x[UX], kCreep));
}

void smooth_accelerations(Motion& motion) {
  const auto size = static_cast<std::ptrdiff_t>(motion.size());
  std::vector<double> mean;
  for (std::ptrdiff_t k = 0; k < size; ++k) {
    double sum = 0;
    const auto first = std::max<std::ptrdiff_t>(0, k - kSmooth);
    const auto last = std::min(size - 1, k + kSmooth);
    for (auto j = first; j <= last; ++j) sum += motion.states[static_cast<std::size_t>(j)][AX];
    mean.push_back(sum / static_cast<double>(last - first + 1));
  }
  for (std::size_t k = 0; k < motion.size(); ++k) motion.states[k][AX] = mean[k];
}

/// Controls by differences of the states.
void find_controls(Motion& motion, const Parameters& p) {
  const double sr = kShare * p.sr_max(), jx = kShare * p.jx_max;
  for (std::size_t k = 0; k + 1 < motion.size(); ++k) {
    const double h = motion.t[k + 1] - motion.t[k];
    const State &a = motion.states[k], &b = motion.states[k + 1];
    motion.controls[k] = {std::clamp((b[SA] - a[SA]) / h, -sr, sr),
                          std::clamp((b[AX] - a[AX]) / h, -jx, jx)};
  }
}

}  // namespace

Standing standing_of(const Parameters& vehicle, bool on_road) {
  if (!on_road || vehicle.footprint == FootprintKind::point)
    return {kCreep, kSpeedSpare, kSettling};
  const double settling = kShare * vehicle.jx_max / -vehicle.ax_min_at(0);
  return {vehicle.ux_min + kBodyCreep, kBodyCreep / 2, std::max(kSettling, settling)};
}

Motion reference_of(const world::Way& way, const Parameters& vehicle) {
  const Stiffness stiffness(vehicle);
  Motion motion;
  for (const auto& w : way) motion.add(w.t, cornering(w, vehicle, stiffness), {});
  smooth_accelerations(motion);
  find_controls(motion, vehicle);
  return motion;
}

Motion braked_on(Motion motion, const Parameters& vehicle, double beyond) {
  const State& last = motion.states.back();
  State x{};
  x[X] = last[X];
  x[Y] = last[Y];
  x[PSI] = direction(last, vehicle);
  const double creep = standing_of(vehicle, false).creep;
  const double braking = kBraking * agility(vehicle).braking;
  x[AX] = -braking;
  double v = last[UX], t = motion.end();
  for (const double end = t + beyond; t < end;) {
    const double slower = std::max(creep, v - braking * kKnot);
    x[X] += kKnot * (v + slower) / 2 * std::cos(x[PSI]);
    x[Y] += kKnot * (v + slower) / 2 * std::sin(x[PSI]);
    x[UX] = v = slower;
    if (v == creep) x[AX] = 0;
    t += kKnot;
    motion.add(t, x, {});
  }
  return motion;
}

Motion swerve_reference(const State& X0, double t0, double side, const Parameters& vehicle) {
  const Stiffness stiffness(vehicle);
  world::WayPoint w{t0, X0[X], X0[Y], direction(X0, vehicle), std::max(X0[UX], kCreep), 0, 0};
  const Agility can = agility(vehicle);
  const double most =
      std::min(kSwerveCurvature * can.curvature, kSwerveLateral * can.lateral / (w.v * w.v));
  Motion motion;
  for (const double end = t0 + 2 * kBend; w.t < end; w.t += kKnot) {
    w.kappa = side * (w.t < t0 + kBend ? most : -most);
    motion.add(w.t, cornering(w, vehicle, stiffness), {});
    const double turned = w.v * w.kappa * kKnot;
    w.x += w.v * kKnot * std::cos(w.heading + turned / 2);
    w.y += w.v * kKnot * std::sin(w.heading + turned / 2);
    w.heading += turned;
  }
  find_controls(motion, vehicle);
  return motion;
}

Motion straight_reference(const State& X0, double t0, double duration) {
  Motion motion;
  State x = X0;
  x[V] = x[R] = x[SA] = x[AX] = 0;
  const auto knots = std::max(2., std::ceil(duration / kKnot));
  for (double k = 0; k <= knots; ++k) {
    const double after = duration * k / knots;
    x[X] = X0[X] + std::cos(X0[PSI]) * X0[UX] * after;
    x[Y] = X0[Y] + std::sin(X0[PSI]) * X0[UX] * after;
    motion.add(t0 + after, x, {});
  }
  return motion;
}

Motion braking_reference(const Motion& reference, const State& X0, double t0, double deceleration,
                         const Parameters& vehicle, bool on_road) {
  const auto [creep, spare, settling] = standing_of(vehicle, on_road);
  // The path by its length, and how far along it X0 is.
  std::vector<double> length{0};
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < reference.size(); ++k) {
    length.push_back(length.back() + apart(reference.states[k], reference.states[k - 1]));
    if (apart(reference.states[k], X0) < apart(reference.states[nearest], X0)) nearest = k;
  }
  Motion motion;
  double s = length[nearest], v = std::max(X0[UX], creep), a = X0[AX];
  std::size_t k = 1;
  for (double t = t0; t < t0 + kLongestStop; t += kKnot) {
    while (k + 1 < reference.size() && length[k] < s) ++k;
    const double gap = length[k] - length[k - 1];
    const double share = gap > 0 ? std::max(0., (s - length[k - 1]) / gap) : 0;
    const State &from = reference.states[k - 1], &to = reference.states[k];
    State x;
    for (std::size_t i = 0; i < kStates; ++i)
      x[i] = from[i] + std::min(share, 1.) * (to[i] - from[i]);
    if (share > 1) {
      x[X] += (s - length[k]) * std::cos(x[PSI]);
      x[Y] += (s - length[k]) * std::sin(x[PSI]);
      x[V] = x[R] = x[SA] = 0;
    }
    const double slower = v / std::max(x[UX], 0.3);
    x[V] *= slower;
    x[R] *= slower;
    x[UX] = v;
    x[AX] = a;
    const double wanted = std::max(-deceleration, -(v - creep) * settling);
    const double jerk =
        std::clamp((wanted - a) / kKnot, -kShare * vehicle.jx_max, kShare * vehicle.jx_max);
    motion.add(t, x, {0, jerk});
    if (v <= creep + 0.02 && std::fabs(a) < 0.02) break;
    a += jerk * kKnot;
    v = std::max(creep, v + a * kKnot);
    s += v * kKnot;
  }
  return motion;
}

}  // namespace slalom::planner
