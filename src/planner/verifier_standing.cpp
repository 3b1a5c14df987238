// How a vehicle that a motion leaves standing goes on, and what it keeps then.

#include <algorithm>
#include <cmath>

#include "verifier.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// A creep is steady after this [s]: slow tyres react within milliseconds.
constexpr double kSteady = 0.5;
/// Below this half of a turn a circle's chord is its arc [rad].
constexpr double kStraight = 1e-6;
/// Standing, distances are looked at this far apart at the least [m]; and this often at the least,
/// where the motion is a trajectory's [s].
constexpr double kLook = 0.01, kLookAgain = 1;

}  // namespace

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

}  // namespace slalom::planner
