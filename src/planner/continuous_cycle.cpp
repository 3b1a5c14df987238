#include "slalom/planner/continuous_cycle.hpp"

#include <utility>

#include "guess.hpp"
#include "obstacle_view.hpp"
#include "trajectory_problem.hpp"

namespace slalom::planner {

ContinuousCycle continuous_cycle(const Task& task, const Request& request) {
  WayAhead way;
  if (task.road)
    way = way_ahead(task, request, std::nullopt);
  else
    way.in_range = goal_in_range(task, request.X0p);
  Settings straight = task.planner;
  straight.prediction = Prediction::constant_velocity;
  const auto obstacles = stand_ins(task.planner, world::Footprint(task.vehicle),
                                   believed(straight, task.obstacles, request.t0));
  TrajectoryProblem stated(task, obstacles, way.in_range);
  stated.update(request, way);
  ocp::Trajectory straight_on = Guess(task)(request, way, nullptr);
  stated.to_problem(way.s, straight_on);
  return {stated.problem(), std::move(straight_on)};
}

}  // namespace slalom::planner
