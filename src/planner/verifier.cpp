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
/// Speed grows by less than this within an interval between knots [m/s], and yaw rate [rad/s].
constexpr double kSpeedSlack = 0.5, kTurnSlack = 0.3;
/// Wheel loads are looked at this often [s] at least. Between, they change by less than what
/// the load needed stands above that at which a wheel lifts.
constexpr double kLoadStep = 0.026;
/// What the integrator and the loop's other choice of instants may add to ax [m/s^2], ux [m/s] and
/// sa [rad] at their limits.
constexpr double kAccelerationSlack = 0.15, kUxSlack = 0.05, kSteeringSlack = 1e-3;
/// A vehicle stands when it is slower than this [m/s] and accelerates by less than this [m/s^2].
constexpr double kStanding = 0.5, kStandingAcceleration = 0.02;
/// A creep is steady after this [s]: slow tyres react within milliseconds.
constexpr double kSteady = 0.5;
/// Below this half of a turn a circle's chord is its arc [rad].
constexpr double kStraight = 1e-6;
/// Standing, distances are looked at this far apart at the least [m]; and this often at the least,
/// where the motion is a trajectory's [s].
constexpr double kLook = 0.01, kLookAgain = 1;
/// A motion that begins beyond a limit is within it after this [s].
constexpr double kToComeBack = 1;
/// Within the goal's square by this much counts as there [m].
constexpr double kInside = 0.1;
/// Another goal is reached by so much [its unit].
constexpr double kWell = 0.02;
/// No point of the body accelerates by more [m/s^2]: the tyres' 10, and as much again for a yaw
/// rate of 1 rad/s, or 2 rad/s^2, five metres off.
constexpr double kMostAcceleration = 20;
/// A motion that begins nearer to the road's edge than is needed keeps that but for this [m].
constexpr double kEdgeSlack = 0.01;

/// The plant's integrator as the loop has it by default.
constexpr double kPlantTolerance = 1e-9, kSampleStep = 0.02;

double speed(const Parameters& p, const State& x) {
  return std::hypot(x[UX], x[V] + p.la * x[R]);
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
  if (!(footprint_.outside(task_.region, x) <= 0)) refuse(t, "outside the region");
  if (within_seen(x) < 0 && certificate.refused.empty()) {
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
  if (!o.present(i.t0, i.t1)) return;
  const bool first = i.t0 - begin_ < kToComeBack;
  const double need =
      first ? std::min(need_.clearance, first_clearance_[obstacle]) : need_.clearance;
  const double margin0 = o.margin(i.t0), margin1 = o.margin(i.t1);
  const double turn = std::max(std::fabs(i.x0[R]), std::fabs(i.x1[R])) + kTurnSlack;
  const double rate = std::max(speed(task_.vehicle, i.x0), speed(task_.vehicle, i.x1)) +
                      kSpeedSlack + o.fastest(i.t0, i.t1) + turn * footprint_.reach() +
                      o.margin_rate;
  const double reach = rate * (i.t1 - i.t0);
  const double d0 = distance_within(footprint_, o, i.x0, i.t0, need + margin0 + reach);
  const double d1 = distance_within(footprint_, o, i.x1, i.t1, need + margin1 + reach);
  note_distance(obstacle, std::min(d0, d1), std::min(d0 - margin0, d1 - margin1));
  if (!(std::min(d0 - margin0, d1 - margin1) >= need))
    return refuse(i.t0, "clearance to " + o.name);
  if ((d0 - margin0 + (d1 - margin1) - reach) / 2 >= need) return;
  if (i.t1 - i.t0 < kShortest) return refuse(i.t0, "clearance to " + o.name);
  const double middle = (i.t0 + i.t1) / 2;
  Control u;
  for (std::size_t c = 0; c < kControls; ++c) u[c] = (i.u0[c] + i.u1[c]) / 2;
  const State x = plant_.advance(i.x0, i.u0, u, i.t0, middle);
  keep_off({i.t0, middle, i.x0, x, i.u0, u}, obstacle);
  keep_off({middle, i.t1, x, i.x1, u, i.u1}, obstacle);
}

/// Along an interval each point of the body is off its chord, and an edge bends away from its own,
/// by less than second derivatives times the square of the duration over 8.
void Verifier::keep_on_road(const Interval& i) {
  const double need = i.t0 - begin_ < kToComeBack && first_edge_ < need_.edge
                          ? std::max(first_edge_ - kEdgeSlack, std::min(first_edge_, 0.))
                          : need_.edge;
  const double turn = std::max(std::fabs(i.x0[R]), std::fabs(i.x1[R])) + kTurnSlack;
  const double fast = std::max(speed(task_.vehicle, i.x0), speed(task_.vehicle, i.x1)) +
                      kSpeedSlack + turn * footprint_.reach();
  const double dt = i.t1 - i.t0;
  const double slack = (kMostAcceleration + task_.road->sharpest() * fast * fast) * dt * dt / 8;
  const double least = std::min(footprint_.edge_distance(*task_.road, i.x0),
                                footprint_.edge_distance(*task_.road, i.x1));
  verdict_.nearest_edge = std::min(verdict_.nearest_edge, least);
  if (!(least >= need)) return refuse(i.t0, "off the road");
  if (least - slack >= need) return;
  if (dt < kShortest) return refuse(i.t0, "off the road");
  const double middle = (i.t0 + i.t1) / 2;
  Control u;
  for (std::size_t c = 0; c < kControls; ++c) u[c] = (i.u0[c] + i.u1[c]) / 2;
  const State x = plant_.advance(i.x0, i.u0, u, i.t0, middle);
  keep_on_road({i.t0, middle, i.x0, x, i.u0, u});
  keep_on_road({middle, i.t1, x, i.x1, u, i.u1});
}

/// Notes the distance to an obstacle and what is left of it beside its margin.
void Verifier::note_distance(std::size_t obstacle, double distance, double spare) {
  verdict_.nearest[obstacle] = std::min(verdict_.nearest[obstacle], spare);
  auto& certificate = verdict_.certificate;
  if (!(distance < certificate.least_clearance)) return;
  certificate.least_clearance = distance;
  certificate.nearest = (*obstacles_)[obstacle].name;
}

/// The vehicle goes on without control: at constant speed along the circle on which its tyres roll,
/// which the plant itself is driven onto.
Verifier::Creep Verifier::creep_of(const Motion& motion) const {
  const State& last = motion.states.back();
  const State steady = plant_.advance(last, {}, {}, motion.end(), motion.end() + kSteady);
  Creep creep{last, last[UX], steady[V] + task_.vehicle.la * steady[R], steady[R]};
  creep.slack = std::fabs(last[AX]);
  creep.fastest = std::hypot(creep.forward, creep.sideways) +
                  std::fabs(creep.turn) * footprint_.reach() +
                  creep.slack * task_.planner.standing_horizon;
  return creep;
}

State Verifier::Creep::after(double time) const {
  const double half = turn * time / 2;
  const double chord = time * (std::fabs(half) < kStraight ? 1 : std::sin(half) / half);
  const double c = std::cos(from[PSI] + half), s = std::sin(from[PSI] + half);
  State x = from;
  x[X] += chord * (forward * c - sideways * s);
  x[Y] += chord * (forward * s + sideways * c);
  x[PSI] += 2 * half;
  return x;
}

/// Creeping on from `end` [s] the vehicle has `room` [m] left, which falls no faster than a point
/// of the body moves.
void Verifier::creep_within(const Creep& creep, double end,
                            const std::function<double(const State&)>& room,
                            const char* otherwise) {
  for (double after = 0; after <= task_.planner.standing_horizon;) {
    const double left = room(creep.after(after)) - creep.astray(after);
    if (!(left >= 0)) return refuse(end + after, otherwise);
    if (creep.fastest == 0) return;
    after += std::max(left, kLook) / creep.fastest;
  }
}

/// Creeping on from `end` [s] it keeps off an obstacle. Distance is looked at as often as both
/// speeds allow it to fall to what is needed. Margins grow no more: plans to come know better.
void Verifier::creep_off(const Creep& creep, double end, std::size_t obstacle) {
  const auto& o = (*obstacles_)[obstacle];
  const double horizon = task_.planner.standing_horizon;
  double after = 0;
  while (after <= horizon) {
    const double t = end + after;
    if (!o.present(t, end + horizon)) break;
    const double spare = footprint_.distance(o, creep.after(after), t) - o.margin(end);
    verdict_.nearest[obstacle] = std::min(verdict_.nearest[obstacle], spare);
    const double left = spare - need_.clearance - creep.astray(after);
    if (!(left >= kLook)) return refuse(t, "standing in the way of " + o.name);
    const double rate =
        creep.fastest + (o.trajectory ? o.fastest(t, t + kLookAgain) : std::hypot(o.vx, o.vy));
    if (rate == 0 && !o.trajectory) break;
    const double step = left / rate;
    after += o.trajectory ? std::min(step, kLookAgain) : step;
  }
}

/// After its end the motion creeps on at the speed and steering angle that it ends with.
void Verifier::stand_for_good(const Motion& motion) {
  const Creep creep = creep_of(motion);
  const double end = motion.end();
  if (task_.road)  // beyond its ends an open road goes on
    creep_within(
        creep, end,
        [&](const State& x) { return footprint_.edge_distance(*task_.road, x) - need_.edge; },
        "standing, but creeping off the road");
  creep_within(
      creep, end, [&](const State& x) { return -footprint_.outside(task_.region, x); },
      "standing, but creeping out of the region");
  if (std::isfinite(need_.seen.radius))
    creep_within(
        creep, end, [&](const State& x) { return within_seen(x); },
        "standing, but creeping out of what is seen");
  for (std::size_t k = 0; k < obstacles_->size(); ++k) creep_off(creep, end, k);
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
  if (last[UX] < kStanding && std::fabs(last[AX]) < kStandingAcceleration)
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
  if (motion.size() < 2) {
    refuse(0, "no motion");
    return verdict_;
  }
  certificate.until = motion.end();
  begin_ = motion.begin();
  first_ = excess_of(motion.states[0], plant_.dynamics().wheel_loads(motion.states[0]));
  note_first_clearances(motion.states[0]);
  if (task_.road) first_edge_ = footprint_.edge_distance(*task_.road, motion.states[0]);
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
