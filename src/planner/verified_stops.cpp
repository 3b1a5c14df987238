// The stops that a cycle considers when nothing leads to the goal.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "references.hpp"
#include "verified_planner.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// How stops brake [m/s^2].
constexpr std::array kStops = {3.4, 2.0, 1.0};
/// A late stop begins so long before it would have to by its braking alone [s], or half-way there.
constexpr double kEarlier = 1.5;
constexpr std::array kLate = {1., 0.5};

/// A motion's knots before t.
Motion before(const Motion& motion, double t) {
  Motion part;
  for (std::size_t k = 0; k < motion.size() && motion.t[k] < t - kSameTime; ++k)
    part.add(motion.t[k], motion.states[k], motion.controls[k]);
  return part;
}

}  // namespace

/// Comes to a creep at no acceleration and no steering rate, and creeps on until then.
Motion VerifiedPlanner::settled(Motion motion, double until) const {
  if (motion.size() < 3) return motion;
  const std::size_t k = motion.size() - 1;
  motion.controls[k] = {};
  motion.states[k] = plant_.advance(motion.states[k - 1], motion.controls[k - 1], {},
                                    motion.t[k - 1], motion.t[k]);
  // A triangle of jerk that takes the acceleration away.
  const double ax = motion.states[k][AX], t = motion.t[k];
  const double length = std::max(0.1, std::fabs(ax) / 2);
  const Control peak{0, -2 * ax / length};
  const State middle = plant_.advance(motion.states[k], {}, peak, t, t + length / 2);
  motion.add(t + length / 2, middle, peak);
  motion.add(t + length, plant_.advance(middle, peak, {}, t + length / 2, t + length), {});
  while (motion.end() < until) {
    const double next = motion.end() + Tracker::kStep;
    motion.add(next, plant_.advance(motion.states.back(), {}, {}, motion.end(), next), {});
  }
  return motion;
}

/// Stops along the rest, as late as what is wrong with it allows, or at once; straight on, and
/// after swerves.
std::vector<VerifiedPlanner::Stop> VerifiedPlanner::stops(const Cycle& cycle) const {
  const State& X0p = cycle.request.X0p;
  const double t0 = cycle.t_start();
  std::vector<Stop> result;
  if (cycle.rest && cycle.rest->motion().size() > 3) {
    const Motion& rest = cycle.rest->motion();
    const auto& certificate = cycle.rest->certificate();
    const double wrong = certificate.verified ? rest.end() : certificate.refused_at;
    for (const double share : kLate) {
      const double speed = rest.state_at(wrong)[UX];
      const double at = t0 + share * (wrong - t0 - speed / kStops[0] - kEarlier);
      if (at > t0 + cycle.tex())
        result.push_back({"late stop along the rest", before(rest, at), rest});
    }
    result.push_back({"stop along the rest", {}, rest});
  }
  result.push_back({"stop straight on", {}, straight_reference(X0p, t0, 1)});
  result.push_back(
      {"stop after a swerve to the left", {}, swerve_reference(X0p, t0, 1, task_.vehicle)});
  result.push_back(
      {"stop after a swerve to the right", {}, swerve_reference(X0p, t0, -1, task_.vehicle)});
  return result;
}

/// Looks for a stop that is good.
void VerifiedPlanner::stop(Cycle& cycle) {
  const State& X0p = cycle.request.X0p;
  const double t0 = cycle.t_start();
  for (const Stop& stop : stops(cycle))
    for (const double deceleration : kStops) {
      const bool at_once = stop.lead.size() < 2;
      const State& from = at_once ? X0p : stop.lead.states.back();
      const double t = at_once ? t0 : stop.lead.end();
      Motion reference = stop.lead;
      if (!at_once) reference.drop_last();
      const Motion braking = braking_reference(stop.path, from, t, deceleration, task_.vehicle);
      for (std::size_t k = 0; k < braking.size(); ++k)
        reference.add(braking.t[k], braking.states[k], braking.controls[k]);
      try {
        Motion motion = tracker_.follow(reference, X0p, t0, reference.end());
        if (consider_anew(cycle, stop.name, settled(std::move(motion), t0 + cycle.beyond())))
          return;
      } catch (const PlantError&) {
      }
    }
}

}  // namespace slalom::planner
