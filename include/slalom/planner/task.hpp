#pragma once

#include "slalom/planner/settings.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/environment.hpp"

namespace slalom::planner {

/// The task of a planner: an environment, the vehicle that it believes in, and its settings.
struct Task : world::Environment {
  vehicle::Parameters vehicle;
  Settings planner;
};

/// Which form of the OCP a cycle solves: whether the goal lies within the LiDAR range of the
/// predicted state.
bool goal_in_range(const Task& task, const vehicle::State& X0p);

/// Whether plans that go through something between their nodes are solved again on finer meshes
/// (Settings::between_nodes). Plain ellipses and a point vehicle have no shape.
bool refines(const Task& task);

/// The distance from a state to the goal [m]: along the road (to its end if the goal is a time,
/// negative beyond it), or straight if there is no road.
double way_left(const Task& task, const vehicle::State& state);

}  // namespace slalom::planner
