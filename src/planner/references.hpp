#pragma once

#include "motion.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/world/way_finder.hpp"

namespace slalom::planner {

/// How a vehicle comes to stand: at which speed [m/s], how near to its least speed it may be [m/s],
/// and at which rate it settles there [1/s]. On a road a body comes nearer to standing, for it
/// creeps off it and into what stands before it, and as fast as its jerk allows.
struct Standing {
  double creep, spare, settling;
};
Standing standing_of(const vehicle::Parameters& vehicle, bool on_road);

/// A way as a reference for the dynamic model: its states in steady cornering with linear tyres (R.
/// Rajamani, Vehicle Dynamics and Control, section 3.1, for a position on the front axle).
Motion reference_of(const world::Way& way, const vehicle::Parameters& vehicle);

/// `motion`, and then straight on for `beyond` [s], braking.
Motion braked_on(Motion motion, const vehicle::Parameters& vehicle, double beyond);

/// From X0 at t0 [s] straight on at its speed for `duration` [s].
Motion straight_reference(const vehicle::State& X0, double t0, double duration);

/// From X0 at t0 [s] aside by a bend and the opposite one, at the speed it has: to the left for
/// `side` = 1, to the right for -1.
Motion swerve_reference(const vehicle::State& X0, double t0, double side,
                        const vehicle::Parameters& vehicle);

/// The path of `reference` driven from X0 at t0 [s] on, braking by `deceleration` [m/s^2] until the
/// vehicle creeps; straight on beyond the path's end.
Motion braking_reference(const Motion& reference, const vehicle::State& X0, double t0,
                         double deceleration, const vehicle::Parameters& vehicle,
                         bool on_road = false);

}  // namespace slalom::planner
