#include "slalom/planner/stated.hpp"

#include <cmath>
#include <utility>

#include "guess.hpp"
#include "trajectory_problem.hpp"

namespace slalom::planner {

StatedCycle stated_cycle(const Settings& settings, const vehicle::Parameters& vehicle,
                         const Goal& goal, const Region& region,
                         const std::vector<Obstacle>& obstacles, const Request& request) {
  Guess guess(settings, goal);
  const bool in_range = std::hypot(request.X0p[vehicle::X] - goal.x,
                                   request.X0p[vehicle::Y] - goal.y) < settings.L_range;
  TrajectoryProblem stated(settings, vehicle, goal, region, obstacles, in_range);
  stated.update(request);
  ocp::Trajectory straight_on = guess(request, in_range, nullptr);
  stated.map().to_planner(straight_on);
  return {stated.problem(), std::move(straight_on)};
}

}  // namespace slalom::planner
