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

}  // namespace

/// Comes to a creep at no acceleration and no steering rate.
Motion VerifiedPlanner::settled(Motion motion) const {
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
  return motion;
}

/// Stops along the rest, straight on, and after swerves.
void VerifiedPlanner::stop(Cycle& cycle) {
  const State& X0p = cycle.request.X0p;
  const double t0 = cycle.t_start();
  std::vector<std::pair<std::string, Motion>> paths;
  if (cycle.rest && cycle.rest->motion().size() > 3)
    paths.emplace_back("stop along the rest", cycle.rest->motion());
  paths.emplace_back("stop straight on", straight_reference(X0p, t0, 1));
  paths.emplace_back("stop after a swerve to the left",
                     swerve_reference(X0p, t0, 1, task_.vehicle));
  paths.emplace_back("stop after a swerve to the right",
                     swerve_reference(X0p, t0, -1, task_.vehicle));
  for (const auto& [name, path] : paths)
    for (const double deceleration : kStops) {
      if (!cycle.good.empty() && cycle.over()) return;
      const Motion reference = braking_reference(path, X0p, t0, deceleration, task_.vehicle);
      try {
        Motion motion = tracker_.follow(reference, X0p, t0, reference.end());
        if (consider_anew(cycle, name, settled(std::move(motion)))) break;
      } catch (const PlantError&) {
      }
    }
}

}  // namespace slalom::planner
