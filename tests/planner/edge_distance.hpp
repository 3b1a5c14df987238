#pragma once

#include <algorithm>

#include "slalom/planner/plan.hpp"
#include "slalom/planner/task.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::planner {

/// Of the vehicle from the road's edges at a plan's nodes [m]; negative beyond them.
inline double least_edge_distance(const Task& task, const Plan& plan) {
  const world::Footprint footprint(task.vehicle);
  double least = 1e9;
  for (const vehicle::State& x : plan.states)
    least = std::min(least, footprint.edge_distance(*task.road, x));
  return least;
}

}  // namespace slalom::planner
