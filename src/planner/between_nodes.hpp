#pragma once

#include <vector>

#include "slalom/planner/plan.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::planner {

/// Depths below this are not looked for [m].
inline constexpr double kPassageResolution = 0.02;

/// How deep a plan goes into an obstacle grown by `margin` [m], between its nodes too, where rows
/// of obstacles do not look: the front axle's centre and the heading on the cubics through each two
/// nodes and their rates (C. de Boor, "A Practical Guide to Splines", chapter IV), obstacles as the
/// plan has them, with the margins of their predictions. Depth 0 where it stays out. `la` [m]: from
/// the c.g. to the front axle.
Passage deepest_passage(const Plan& plan, const std::vector<world::Obstacle>& obstacles,
                        double margin, const world::Footprint& footprint, double la);

/// The same at its nodes alone [m].
double deepest_at_nodes(const Plan& plan, const std::vector<world::Obstacle>& obstacles,
                        double margin, const world::Footprint& footprint);

/// How far a plan's footprint goes beyond an edge of its road between its nodes, on the same
/// cubics. Depth 0 where it stays on the road, or leaves it by less than kPassageResolution.
RoadExit farthest_exit(const Plan& plan, const world::Road& road, const world::Footprint& footprint,
                       double la);

}  // namespace slalom::planner
