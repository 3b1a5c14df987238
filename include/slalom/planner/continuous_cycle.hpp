#pragma once

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/planner/task.hpp"

namespace slalom::planner {

/// One planning cycle as an optimal-control problem in continuous time, with the guess of a first
/// cycle: straight on at the predicted heading and speed.
struct ContinuousCycle {
  ocp::Problem problem;
  ocp::Trajectory guess;
};

/// The OCP of section 3 of docs/formulation.md for `request`. Any scheme, mesh and solver may solve
/// it; the task's settings for these are ignored. Obstacles with a trajectory go straight on.
ContinuousCycle continuous_cycle(const Task& task, const Request& request);

}  // namespace slalom::planner
