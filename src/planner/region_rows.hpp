#pragma once

#include <array>

#include "slalom/ocp/problem.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/region.hpp"

namespace slalom::planner {

/// Bounds of the front axle's place that keep a point within a region; none of a body.
std::array<ocp::Bounds, 2> region_bounds(const world::Region& region,
                                         const world::Footprint& footprint);

/// Adds rows to a problem with these states that keep the corners of a body within a region: one
/// for each side that is there and each corner. None of a point.
void add_region_rows(ocp::Problem& problem, const world::Region& region,
                     const world::Footprint& footprint,
                     const std::array<ocp::Expr, vehicle::kStates>& states, ocp::Points points);

}  // namespace slalom::planner
