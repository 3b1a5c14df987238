#pragma once

#include "slalom/vehicle/parameters.hpp"

namespace slalom::vehicle {

/// What a vehicle can do, as multiples of what the HMMWV can, for which the planners' own limits
/// were found: each of these times the limit is another vehicle's. All are exactly 1 of the HMMWV.
struct Agility {
  double braking = 1;         ///< by ax_min at standstill
  double lateral = 1;         ///< acceleration at which a tyre slides or a wheel is at Fz_min
  double curvature = 1;       ///< by sa_max and the axles' distance
  double curvature_rate = 1;  ///< by sr_max and the axles' distance
};

Agility agility(const Parameters& parameters);

/// What no motion of the vehicle exceeds, by the greatest forces of its tyres under any load that
/// hard driving and braking give an axle: accelerations of the front axle's centre along and across
/// the vehicle [m/s^2], the first beside what yawing adds, and of yaw [rad/s^2].
struct Quickness {
  double along, across, yaw;
};

Quickness quickness(const Parameters& parameters);

/// Steady lateral acceleration [m/s^2] at which the tyres slide or an inner wheel has Fz_min left.
double most_lateral(const Parameters& parameters);

}  // namespace slalom::vehicle
