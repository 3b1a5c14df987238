#pragma once

#include <vector>

#include "slalom/planner/planner.hpp"
#include "slalom/planner/settings.hpp"
#include "slalom/planner/task.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::planner {

/// Obstacles as a planner that plans at t0 [s] takes them to move (Settings::prediction), and the
/// seconds ahead of their margins counted from then.
std::vector<world::Obstacle> believed(const Settings& settings,
                                      std::vector<world::Obstacle> obstacles, double t0);

/// Whether believed() depends on when one plans.
bool belief_varies(const Settings& settings, const std::vector<world::Obstacle>& obstacles);

/// Where the vehicle is when it plans, at t0: as far behind X0p as it drives by then.
world::Point planning_place(const Request& request);

/// Obstacles among which a verifying planner plans: those of the request, else of the task, as
/// believed; with `known: range` those alone that are there and within L_range of the vehicle's
/// footprint when it plans.
std::vector<world::Obstacle> known_obstacles(const Task& task, const Request& request);

}  // namespace slalom::planner
