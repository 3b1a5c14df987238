#include "slalom/planner/task.hpp"

#include <algorithm>
#include <cmath>

#include "road_way.hpp"

namespace slalom::planner {

bool goal_in_range(const Task& task, const vehicle::State& X0p) {
  return std::hypot(X0p[vehicle::X] - task.goal.x, X0p[vehicle::Y] - task.goal.y) <
         task.planner.L_range;
}

bool refines(const Task& task) {
  if (task.planner.between_nodes != BetweenNodes::by_shape)
    return task.planner.between_nodes == BetweenNodes::refine;
  return task.vehicle.footprint != vehicle::FootprintKind::point ||
         std::any_of(task.obstacles.begin(), task.obstacles.end(),
                     [](const world::Obstacle& o) { return !o.is_plain(); });
}

double way_left(const Task& task, const vehicle::State& state) {
  const world::Goal& goal = task.goal;
  if (!task.road) return std::hypot(state[vehicle::X] - goal.x, state[vehicle::Y] - goal.y);
  const double s = task.road->project({state[vehicle::X], state[vehicle::Y]}).s;
  if (goal.is_place() || goal.kind() == world::GoalKind::line)
    return std::fabs(goal_ahead(task, s));
  return task.road->length() - s;
}

}  // namespace slalom::planner
