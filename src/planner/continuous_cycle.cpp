#include "slalom/planner/continuous_cycle.hpp"

#include <utility>

#include "guess.hpp"
#include "trajectory_problem.hpp"

namespace slalom::planner {

ContinuousCycle continuous_cycle(const Task& task, const Request& request) {
  const bool in_range = goal_in_range(task, request.X0p);
  Settings straight = task.planner;
  straight.prediction = Prediction::constant_velocity;
  const auto obstacles = covered(task.planner, world::Footprint(task.vehicle),
                                 believed(straight, task.obstacles, request.t0));
  TrajectoryProblem stated(task, obstacles, in_range);
  stated.update(request);
  ocp::Trajectory straight_on = Guess(task)(request, in_range, nullptr);
  stated.map().to_planner(straight_on);
  return {stated.problem(), std::move(straight_on)};
}

}  // namespace slalom::planner
