#pragma once

#include "motion.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

/// From X0 at t0 [s] along a road at the offset from its line that X0 has, or as far from its edges
/// as the body needs, for `duration` [s], braking by `deceleration` [m/s^2] until the vehicle
/// creeps: in steady cornering, as reference_of() has it. `aside`, from -1 to 1, moves it over at
/// once, by this share of the room that the body has to the road's right (-) or left edge.
Motion road_reference(const world::Road& road, const vehicle::State& X0, double t0, double duration,
                      double deceleration, const vehicle::Parameters& vehicle, double aside = 0);
/// The same where it is known where X0 is on the road; less than no deceleration is acceleration.
Motion road_reference(const world::Road& road, const world::OnRoad& on, const vehicle::State& X0,
                      double t0, double duration, double deceleration,
                      const vehicle::Parameters& vehicle, double aside = 0);

/// `motion`, and then on for `beyond` [s], braking: along the road, or straight where there is
/// none.
Motion braked_on(Motion motion, const vehicle::Parameters& vehicle, const world::Road* road,
                 double beyond);

}  // namespace slalom::planner
