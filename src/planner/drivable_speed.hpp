#pragma once

#include "line_problem.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

/// The greatest speed [m/s] at which a vehicle steers fast enough for a road's bend about s. Where
/// the curvature of its path changes by c over a length l and not at once, the path is off the
/// road's line by c l^2 / 24, the shift of a clothoid: as long as that leaves room on the road, a
/// change may take.
double steerable_speed(const world::Road& road, const vehicle::Parameters& vehicle, double s);

/// Speeds from which a vehicle can drive on along a road, by shares of lateral acceleration and
/// braking, and by what it steers. Beyond its ends an open road goes on straight.
SpeedProfile drivable_speeds(const world::Road& road, const vehicle::Parameters& vehicle,
                             double lateral_share, double braking_share);

}  // namespace slalom::planner
