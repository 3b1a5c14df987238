#pragma once

#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/planner/goal.hpp"
#include "slalom/planner/obstacle.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/planner/settings.hpp"
#include "slalom/vehicle/parameters.hpp"

namespace slalom::planner {

/// One planning cycle as an optimal-control problem in continuous time, with the guess of a first
/// one: straight on at the predicted heading and speed.
struct StatedCycle {
  ocp::Problem problem;
  ocp::Trajectory guess;
};

/// The OCP of section 3 of docs/formulation.md for `request`, to be solved by any scheme, mesh and
/// solver; settings of these are not looked at.
StatedCycle stated_cycle(const Settings& settings, const vehicle::Parameters& vehicle,
                         const Goal& goal, const Region& region,
                         const std::vector<Obstacle>& obstacles, const Request& request);

}  // namespace slalom::planner
