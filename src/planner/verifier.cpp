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
/// Where loads come this near to what is needed, as a share of a wheel's mean static load, the
/// plant itself says what they are between two knots.
constexpr double kLowLoad = 0.05;
/// What the integrator and the loop's other choice of instants may add to ax [m/s^2], ux [m/s] and
/// sa [rad] at their limits.
constexpr double kAccelerationSlack = 0.15, kUxSlack = 0.05, kSteeringSlack = 1e-3;
/// A vehicle stands when it is slower than this [m/s] and accelerates by less than this [m/s^2].
constexpr double kStanding = 0.5, kStandingAcceleration = 0.02;
/// A motion that begins beyond a limit is within it after this [s].
constexpr double kToComeBack = 1;
/// One that begins outside the region is within it after this [s], and goes so much further out
/// meanwhile at the most [m]: a vehicle cannot turn on the spot.
constexpr double kToReturn = 4, kFurtherOut = 0.5;
/// Within the goal's square by this much counts as there [m].
constexpr double kInside = 0.1;
/// Another goal is reached by so much [its unit].
constexpr double kWell = 0.02;
/// A motion that begins nearer to the road's edge than is needed keeps that but for this [m].
constexpr double kEdgeSlack = 0.01;

/// The plant's integrator as the loop has it by default.
constexpr double kPlantTolerance = 1e-9, kSampleStep = 0.02;

/// Of the front axle's centre across the vehicle [m/s].
double across(const Parameters& p, const State& x) {
  return x[V] + p.la * x[R];
}

/// Distance of the footprint to an obstacle's edge, or a lower bound of it where it is beyond
/// `far`.
double distance_within(const world::Footprint& footprint, const world::Obstacle& o, const State& x,
                       double t, double far) {
  const world::Pose at = o.pose_at(t);
  const double bound = std::hypot(x[X] - at.x, x[Y] - at.y) - o.reach() - footprint.reach();
  const bool exact = o.a == o.b && !o.outline && footprint.is_point();
  return bound > far || exact ? bound : footprint.distance(o, x, t);
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

  double duration() const { return t1 - t0; }
};

/// Of any point of the body within an interval [m/s], [m/s^2].
struct Verifier::Fastest {
  double speed, acceleration;
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

/// How far within what is seen the vehicle keeps what it needs to all that may stand beyond [m].
double Verifier::within_seen(const State& x) const {
  return need_.seen.radius - need_.clearance - footprint_.reach() -
         std::hypot(x[X] - need_.seen.x, x[Y] - need_.seen.y);
}

/// Where the motion begins beyond a limit, it has a while to come back, and goes no further.
/// Returns the wheel loads.
WheelLoads Verifier::note_limits(double t, const State& x) {
  auto& certificate = verdict_.certificate;
  const WheelLoads loads = plant_.dynamics().wheel_loads(x);
  const Excess excess = excess_of(x, loads);
  const Excess allowed = t - begin_ < kToComeBack ? first_ : Excess{};
  for (std::size_t w = 0; w < kWheels; ++w) {
    certificate.least_wheel_load = std::min(certificate.least_wheel_load, loads[w]);
    if (!(excess.load[w] <= allowed.load[w]))
      refuse(t, fmt::format("wheel load {} of {:.0f} N", kWheelNames[w], loads[w]));
  }
  const bool returns = first_outside_ > 0 && t - begin_ < kToReturn;
  if (!(footprint_.outside(task_.region, x) <= (returns ? first_outside_ + kFurtherOut : 0)))
    refuse(t, "outside the region");
  if (within_seen(x) < 0 && certificate.refused.empty()) {
    refuse(t, "beyond what is seen");
    verdict_.unseen = true;
  }
  if (!(excess.ux <= allowed.ux)) refuse(t, fmt::format("speed of {:.4g} m/s", x[UX]));
  if (!(excess.sa <= allowed.sa)) refuse(t, "steering angle");
  if (!(excess.ax <= allowed.ax)) refuse(t, fmt::format("acceleration of {:.3g} m/s^2", x[AX]));
  return loads;
}

/// From the nearer end on, for half the interval at the most, by what the vehicle's tyres can do.
Verifier::Fastest Verifier::fastest(const Interval& i) const {
  const auto greater = [](double a, double b) { return std::max(std::fabs(a), std::fabs(b)); };
  const Parameters& p = task_.vehicle;
  const double half = i.duration() / 2;
  const double turn = greater(i.x0[R], i.x1[R]) + quickness_.yaw * half;
  const double sideways = greater(across(p, i.x0), across(p, i.x1)) + quickness_.across * half;
  // The speed along the vehicle changes by ax; its direction in space turns.
  const double acceleration = std::hypot(quickness_.along + sideways * turn, quickness_.across);
  const double speed =
      std::max(std::hypot(i.x0[UX], across(p, i.x0)), std::hypot(i.x1[UX], across(p, i.x1))) +
      acceleration * half;
  const double reach = footprint_.reach();
  return {speed + turn * reach, acceleration + (quickness_.yaw + turn * turn) * reach};
}

/// Judges both halves of an interval; the plant gives the state between them.
template <class Judge>
void Verifier::halve(const Interval& i, const Judge& judge) const {
  const double middle = (i.t0 + i.t1) / 2;
  Control u;
  for (std::size_t c = 0; c < kControls; ++c) u[c] = (i.u0[c] + i.u1[c]) / 2;
  const State x = plant_.advance(i.x0, i.u0, u, i.t0, middle);
  judge({i.t0, middle, i.x0, x, i.u0, u}, {middle, i.t1, x, i.x1, u, i.u1});
}

/// Loads at the ends of an interval and in its middle leave out a dip between. A parabola through
/// the three dips below all by a quarter of what it is off the chord in the middle; four times that
/// is allowed for.
void Verifier::keep_loads(const Interval& i, const WheelLoads& first, const WheelLoads& last) {
  const auto least = [](const WheelLoads& loads) {
    return *std::min_element(loads.begin(), loads.end());
  };
  const Parameters& p = task_.vehicle;
  const double low = need_.wheel_load + kLowLoad * (p.FzF0 + p.FzR0) / kWheels;
  if (std::min(least(first), least(last)) >= low) {
    State mean;
    for (std::size_t s = 0; s < kStates; ++s) mean[s] = (i.x0[s] + i.x1[s]) / 2;
    if (least(plant_.dynamics().wheel_loads(mean)) >= low) return;
  }
  halve(i, [&](const Interval& a, const Interval& b) {
    const WheelLoads middle = note_limits(a.t1, a.x1);
    if (!verdict_.certificate.refused.empty()) return;
    const Excess allowed = i.t0 - begin_ < kToComeBack ? first_ : Excess{};
    bool holds = true;
    for (std::size_t w = 0; w < kWheels; ++w) {
      const double off = std::fabs((first[w] + last[w]) / 2 - middle[w]);
      const double bound = std::min({first[w], middle[w], last[w]}) - off;
      holds = holds && bound >= need_.wheel_load - allowed.load[w];
    }
    if (holds || i.duration() < kShortest) return;
    keep_loads(a, first, middle);
    keep_loads(b, middle, last);
  });
}

/// Along an interval, distance falls below the mean of its ends by half the way that vehicle and
/// obstacle can go towards each other at the most.
void Verifier::keep_off(const Interval& i, std::size_t obstacle) {
  const auto& o = (*obstacles_)[obstacle];
  if (!o.present(i.t0, i.t1)) return;
  const bool first = i.t0 - begin_ < kToComeBack;
  const double need =
      first ? std::min(need_.clearance, first_clearance_[obstacle]) : need_.clearance;
  const double margin0 = o.margin(i.t0), margin1 = o.margin(i.t1);
  const double rate = fastest(i).speed + o.fastest(i.t0, i.t1) + o.margin_rate;
  const double reach = rate * i.duration();
  const double d0 = distance_within(footprint_, o, i.x0, i.t0, need + margin0 + reach);
  const double d1 = distance_within(footprint_, o, i.x1, i.t1, need + margin1 + reach);
  auto& proved = verdict_.certificate.proved_clearance;
  proved = std::min(proved, need);
  note_distance(obstacle, std::min(d0, d1), std::min(d0 - margin0, d1 - margin1));
  if (!(std::min(d0 - margin0, d1 - margin1) >= need))
    return refuse(i.t0, "clearance to " + o.name);
  if ((d0 - margin0 + (d1 - margin1) - reach) / 2 >= need) return;
  if (i.duration() < kShortest) return refuse(i.t0, "clearance to " + o.name);
  halve(i, [&](const Interval& a, const Interval& b) {
    keep_off(a, obstacle);
    keep_off(b, obstacle);
  });
}

/// Along an interval each point of the body is off its chord, and an edge bends away from its own,
/// by less than second derivatives times the square of the duration over 8.
void Verifier::keep_on_road(const Interval& i) {
  const double need = i.t0 - begin_ < kToComeBack && first_edge_ < need_.edge
                          ? std::max(first_edge_ - kEdgeSlack, std::min(first_edge_, 0.))
                          : need_.edge;
  const Fastest most = fastest(i);
  const double bend = task_.road->sharpest() * most.speed * most.speed;
  const double dt = i.duration();
  const double slack = (most.acceleration + bend) * dt * dt / 8;
  const double least = std::min(footprint_.edge_distance(*task_.road, i.x0),
                                footprint_.edge_distance(*task_.road, i.x1));
  verdict_.nearest_edge = std::min(verdict_.nearest_edge, least);
  if (!(least >= need)) return refuse(i.t0, "off the road");
  if (least - slack >= need) return;
  if (dt < kShortest) return refuse(i.t0, "off the road");
  halve(i, [&](const Interval& a, const Interval& b) {
    keep_on_road(a);
    keep_on_road(b);
  });
}

/// Notes the distance to an obstacle and what is left of it beside its margin.
void Verifier::note_distance(std::size_t obstacle, double distance, double spare) {
  verdict_.nearest[obstacle] = std::min(verdict_.nearest[obstacle], spare);
  auto& certificate = verdict_.certificate;
  if (!(distance < certificate.least_clearance)) return;
  certificate.least_clearance = distance;
  certificate.nearest = (*obstacles_)[obstacle].name;
}

/// A body that begins nearer to an obstacle than is needed keeps that, but for kEdgeSlack. Of a
/// point, which stands for a body, what is needed is kept from the beginning.
void Verifier::note_first_clearances(const State& x) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  first_clearance_.assign(obstacles_->size(), inf);
  if (footprint_.is_point()) return;
  for (std::size_t k = 0; k < obstacles_->size(); ++k) {
    const auto& o = (*obstacles_)[k];
    if (!o.present(begin_, begin_)) continue;
    const double spare = footprint_.distance(o, x, begin_) - o.margin(begin_);
    first_clearance_[k] = std::max(0., spare - kEdgeSlack);
  }
}

void Verifier::find_end_by_square(const Motion& motion, const Looks& looks) {
  const auto outside = [&](const State& x, double t) { return task_.goal.outside(x, t, nullptr); };
  const double first = std::ceil((motion.begin() - looks.from) / looks.every - kSameTime);
  for (double k = first; looks.from + k * looks.every <= motion.end() + kSameTime; ++k) {
    const double t = looks.from + k * looks.every;
    if (outside(motion.state_at(t), t) > -kInside) continue;
    verdict_.end = MotionEnd::arrives;
    verdict_.arrival = t;
    // The square's edge is passed a little earlier, which tells motions apart that are looked at
    // at the same moment.
    for (std::size_t knot = motion.size(); knot-- > 0;)
      if (motion.t[knot] <= t) {
        if (outside(motion.states[knot], motion.t[knot]) > 0) break;
        verdict_.arrival = motion.t[knot];
      }
    return;
  }
}

void Verifier::find_end(const Motion& motion, const Looks& looks) {
  if (task_.goal.kind() == world::GoalKind::square) {
    find_end_by_square(motion, looks);
  } else {
    for (std::size_t k = 0; k < motion.size() && verdict_.end == MotionEnd::open; ++k) {
      if (task_.goal.outside(motion.states[k], motion.t[k], task_.road.get()) > -kWell) continue;
      verdict_.end = MotionEnd::arrives;
      verdict_.arrival = motion.t[k];
    }
  }
  if (verdict_.end == MotionEnd::arrives) return;
  const State& last = motion.states.back();
  // Beyond its end the last control holds: it must be none.
  if (last[UX] < kStanding && std::fabs(last[AX]) < kStandingAcceleration &&
      motion.controls.back() == Control{})
    verdict_.end = MotionEnd::stands;
}

Verdict Verifier::judge(const Motion& motion, const std::vector<world::Obstacle>& obstacles,
                        const Need& need, const Looks& looks) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  obstacles_ = &obstacles;
  need_ = need;
  verdict_ = {};
  verdict_.need = need;
  verdict_.nearest.assign(obstacles.size(), inf);
  auto& certificate = verdict_.certificate;
  certificate.least_clearance = certificate.least_wheel_load = inf;
  certificate.proved_clearance = obstacles.empty() ? inf : need.clearance;
  if (motion.size() < 2) {
    refuse(0, "no motion");
    return verdict_;
  }
  certificate.until = motion.end();
  begin_ = motion.begin();
  first_ = excess_of(motion.states[0], plant_.dynamics().wheel_loads(motion.states[0]));
  first_outside_ = footprint_.outside(task_.region, motion.states[0]);
  note_first_clearances(motion.states[0]);
  if (task_.road) first_edge_ = footprint_.edge_distance(*task_.road, motion.states[0]);
  WheelLoads loads = note_limits(motion.t[0], motion.states[0]);
  for (std::size_t k = 0; k + 1 < motion.size() && certificate.refused.empty(); ++k) {
    const Interval i{motion.t[k],          motion.t[k + 1],    motion.states[k],
                     motion.states[k + 1], motion.controls[k], motion.controls[k + 1]};
    const WheelLoads before = std::exchange(loads, note_limits(i.t1, i.x1));
    try {
      keep_loads(i, before, loads);
      for (std::size_t o = 0; o < obstacles.size(); ++o) keep_off(i, o);
      if (task_.road) keep_on_road(i);
    } catch (const PlantError& error) {
      refuse(i.t0, error.what());
    }
  }
  find_end(motion, looks);
  if (certificate.refused.empty()) {
    if (verdict_.end == MotionEnd::open) refuse(motion.end(), "it neither arrives nor stands");
    try {
      if (verdict_.end == MotionEnd::stands) stand_for_good(motion);
    } catch (const PlantError& error) {
      refuse(motion.end(), error.what());
    }
  }
  certificate.verified = certificate.refused.empty();
  return verdict_;
}

}  // namespace slalom::planner
