#include "verifier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace slalom::planner {
namespace {

using namespace vehicle;

/// An interval as short as this [s] is not divided further: what its bound does not show is
/// refused.
constexpr double kShortest = 1e-4;
/// Speed grows by less than this within an interval between knots [m/s].
constexpr double kSpeedSlack = 0.5;
/// Wheel loads are looked at this often [s] at least. Between, they change by less than what
/// the load needed stands above that at which a wheel lifts.
constexpr double kLoadStep = 0.026;
/// What the integrator and the loop's other choice of instants may add to ax [m/s^2], ux [m/s] and
/// sa [rad] at their limits.
constexpr double kAccelerationSlack = 0.15, kUxSlack = 0.05, kSteeringSlack = 1e-3;
/// A vehicle stands when it is slower than this [m/s] and accelerates by less than this [m/s^2].
constexpr double kStanding = 0.5, kStandingAcceleration = 0.02;
/// Standing, distances are looked at this far apart at the least [m].
constexpr double kLook = 0.01;
/// A motion that begins beyond a limit is within it after this [s].
constexpr double kToComeBack = 1;
/// Within the goal's square by this much counts as there [m].
constexpr double kInside = 0.1;

/// The plant's integrator as the loop has it by default.
constexpr double kPlantTolerance = 1e-9, kSampleStep = 0.02;

double speed(const Parameters& p, const State& x) {
  return std::hypot(x[UX], x[V] + p.la * x[R]);
}

/// Distance to an obstacle's edge, or a lower bound of it where it is beyond `far`.
double distance_within(const world::Obstacle& o, const State& x, double t, double far) {
  const double dx = x[X] - o.x_at(t), dy = x[Y] - o.y_at(t);
  const double bound = std::hypot(dx, dy) - std::max(o.a, o.b);
  return bound > far || o.a == o.b ? bound : world::distance(o, x[X], x[Y], t);
}

/// By how much a value is beyond its range.
double beyond(double value, double least, double most) {
  return std::max({least - value, value - most, 0.});
}

}  // namespace

/// Between two knots, or a part of it.
struct Verifier::Interval {
  double t0, t1;
  const State &x0, &x1;
  Control u0, u1;
};

Plant Verifier::believed_plant(const Parameters& vehicle) {
  return {vehicle, kPlantTolerance, kSampleStep};
}

void Verifier::refuse(double t, std::string why) {
  auto& certificate = verdict_.certificate;
  if (!certificate.refused.empty()) return;
  certificate.refused = fmt::format("{} at {:.4g} s", why, t);
  certificate.refused_at = t;
}

Verifier::Excess Verifier::excess_of(const State& x, const WheelLoads& loads) const {
  const Parameters& p = task_.vehicle;
  constexpr double inf = std::numeric_limits<double>::infinity();
  Excess excess;
  for (std::size_t w = 0; w < kWheels; ++w)
    excess.load[w] = beyond(loads[w], need_.wheel_load, inf);
  excess.ux = beyond(x[UX], p.ux_min, p.ux_max + kUxSlack);
  excess.sa = beyond(x[SA], -p.sa_max() - kSteeringSlack, p.sa_max() + kSteeringSlack);
  excess.ax = beyond(x[AX], p.ax_min_at(x[UX]) - kAccelerationSlack,
                     p.ax_max_at(x[UX]) + kAccelerationSlack);
  return excess;
}

/// Where the motion begins beyond a limit, it has a while to come back, and goes no further.
void Verifier::note_limits(double t, const State& x) {
  auto& certificate = verdict_.certificate;
  const WheelLoads loads = plant_.dynamics().wheel_loads(x);
  const Excess excess = excess_of(x, loads);
  const Excess allowed = t - begin_ < kToComeBack ? first_ : Excess{};
  for (std::size_t w = 0; w < kWheels; ++w) {
    certificate.least_wheel_load = std::min(certificate.least_wheel_load, loads[w]);
    if (!(excess.load[w] <= allowed.load[w]))
      refuse(t, fmt::format("wheel load {} of {:.0f} N", kWheelNames[w], loads[w]));
  }
  if (!task_.region.contains(x[X], x[Y])) refuse(t, "outside the region");
  if (std::hypot(x[X] - need_.seen.x, x[Y] - need_.seen.y) > need_.seen.radius - need_.clearance &&
      certificate.refused.empty()) {
    refuse(t, "beyond what is seen");
    verdict_.unseen = true;
  }
  if (!(excess.ux <= allowed.ux)) refuse(t, fmt::format("speed of {:.4g} m/s", x[UX]));
  if (!(excess.sa <= allowed.sa)) refuse(t, "steering angle");
  if (!(excess.ax <= allowed.ax)) refuse(t, fmt::format("acceleration of {:.3g} m/s^2", x[AX]));
}

/// Along an interval, distance falls below the mean of its ends by half the way that vehicle and
/// obstacle can go towards each other at the most.
void Verifier::keep_off(const Interval& i, std::size_t obstacle) {
  const auto& o = (*obstacles_)[obstacle];
  const double need = need_.clearance;
  const double rate = std::max(speed(task_.vehicle, i.x0), speed(task_.vehicle, i.x1)) +
                      kSpeedSlack + std::hypot(o.vx, o.vy);
  const double reach = rate * (i.t1 - i.t0);
  const double d0 = distance_within(o, i.x0, i.t0, need + reach);
  const double d1 = distance_within(o, i.x1, i.t1, need + reach);
  auto& certificate = verdict_.certificate;
  const double least = std::min(d0, d1);
  verdict_.nearest[obstacle] = std::min(verdict_.nearest[obstacle], least);
  if (least < certificate.least_clearance) {
    certificate.least_clearance = least;
    certificate.nearest = o.name;
  }
  if (!(least >= need)) return refuse(i.t0, "clearance to " + o.name);
  if ((d0 + d1 - reach) / 2 >= need) return;
  if (i.t1 - i.t0 < kShortest) return refuse(i.t0, "clearance to " + o.name);
  const double middle = (i.t0 + i.t1) / 2;
  Control u;
  for (std::size_t c = 0; c < kControls; ++c) u[c] = (i.u0[c] + i.u1[c]) / 2;
  const State x = plant_.advance(i.x0, i.u0, u, i.t0, middle);
  keep_off({i.t0, middle, i.x0, x, i.u0, u}, obstacle);
  keep_off({middle, i.t1, x, i.x1, u, i.u1}, obstacle);
}

/// After its end the motion goes on straight at the speed it ends with. Distance is looked at as
/// often as both speeds allow it to fall to what is needed.
void Verifier::stand_for_good(const Motion& motion) {
  const State& x = motion.states.back();
  const double forward_x = std::cos(x[PSI]) * x[UX], forward_y = std::sin(x[PSI]) * x[UX];
  const double need = need_.clearance;
  for (std::size_t k = 0; k < obstacles_->size(); ++k) {
    const auto& o = (*obstacles_)[k];
    const double rate = std::hypot(o.vx - forward_x, o.vy - forward_y);
    double after = 0;
    while (after <= task_.planner.standing_horizon) {
      const double d = world::distance(o, x[X] + forward_x * after, x[Y] + forward_y * after,
                                       motion.end() + after);
      verdict_.nearest[k] = std::min(verdict_.nearest[k], d);
      if (!(d >= need + kLook))
        return refuse(motion.end() + after, "standing in the way of " + o.name);
      if (rate == 0) break;
      after += std::max(d - need, kLook) / rate;
    }
  }
}

void Verifier::find_end(const Motion& motion, double tex) {
  const auto outside = [&](const State& x, double t) {
    return task_.goal.outside(x, t, task_.road.get());
  };
  const bool by_time = task_.goal.kind() == world::GoalKind::time;
  const double inside = by_time ? 0 : kInside;
  for (double t = motion.begin(); t <= motion.end() + 1e-9; t += tex) {
    // The loop looks when the time is up, too.
    if (by_time && t > task_.goal.time && t - tex < task_.goal.time) t = task_.goal.time;
    if (outside(motion.state_at(t), t) > -inside) continue;
    verdict_.end = MotionEnd::arrives;
    verdict_.arrival = t;
    // The square's edge is passed a little earlier, which tells motions apart that are looked at
    // at the same moment.
    for (std::size_t k = motion.size(); k-- > 0;)
      if (motion.t[k] <= t) {
        if (outside(motion.states[k], motion.t[k]) > 0) break;
        verdict_.arrival = motion.t[k];
      }
    return;
  }
  const State& last = motion.states.back();
  if (last[UX] < kStanding && std::fabs(last[AX]) < kStandingAcceleration)
    verdict_.end = MotionEnd::stands;
}

Verdict Verifier::judge(const Motion& motion, const std::vector<world::Obstacle>& obstacles,
                        const Need& need, double tex) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  obstacles_ = &obstacles;
  need_ = need;
  verdict_ = {};
  verdict_.need = need;
  verdict_.nearest.assign(obstacles.size(), inf);
  auto& certificate = verdict_.certificate;
  certificate.least_clearance = certificate.least_wheel_load = inf;
  if (motion.size() < 2) {
    refuse(0, "no motion");
    return verdict_;
  }
  certificate.until = motion.end();
  begin_ = motion.begin();
  first_ = excess_of(motion.states[0], plant_.dynamics().wheel_loads(motion.states[0]));
  note_limits(motion.t[0], motion.states[0]);
  for (std::size_t k = 0; k + 1 < motion.size() && certificate.refused.empty(); ++k) {
    const Interval i{motion.t[k],          motion.t[k + 1],    motion.states[k],
                     motion.states[k + 1], motion.controls[k], motion.controls[k + 1]};
    note_limits(i.t1, i.x1);
    if (i.t1 - i.t0 > kLoadStep) {
      const double middle = (i.t0 + i.t1) / 2;
      State x;
      for (std::size_t s = 0; s < kStates; ++s) x[s] = (i.x0[s] + i.x1[s]) / 2;
      note_limits(middle, x);
    }
    try {
      for (std::size_t o = 0; o < obstacles.size(); ++o) keep_off(i, o);
    } catch (const PlantError& error) {
      refuse(i.t0, error.what());
    }
  }
  find_end(motion, tex);
  if (certificate.refused.empty()) {
    if (verdict_.end == MotionEnd::open) refuse(motion.end(), "it neither arrives nor stands");
    if (verdict_.end == MotionEnd::stands) stand_for_good(motion);
  }
  certificate.verified = certificate.refused.empty();
  return verdict_;
}

}  // namespace slalom::planner
