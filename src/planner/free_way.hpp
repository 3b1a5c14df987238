#pragma once

#include <vector>

#include "slalom/ocp/trajectory.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::planner {

/// What a guess along a road keeps clear of, and by how much [m].
struct ToPass {
  const std::vector<world::Obstacle>& obstacles;
  double margin;  ///< of the footprint from them
  double edge;    ///< and from the road's edges
};

/// A guess along the road, from absolute time t_start [s] on, moved sideways to where obstacles
/// leave room: the same lengths at the same times, at the offsets that dynamic programming finds
/// (R. Bellman, "Dynamic programming", 1957) on a lattice of lengths and offsets, with little
/// change of offset, and little of margin given up where there is no room. Its start stays.
ocp::Trajectory free_way(ocp::Trajectory guess, const world::Road& road,
                         const world::Footprint& footprint, double t_start, const ToPass& pass);

}  // namespace slalom::planner
