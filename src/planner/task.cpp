#include "slalom/planner/task.hpp"

#include <cmath>

namespace slalom::planner {

bool goal_in_range(const Task& task, const vehicle::State& X0p) {
  return std::hypot(X0p[vehicle::X] - task.goal.x, X0p[vehicle::Y] - task.goal.y) <
         task.planner.L_range;
}

}  // namespace slalom::planner
