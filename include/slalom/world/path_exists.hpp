#pragma once

#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/environment.hpp"

namespace slalom::world {

/// The search of path_exists(), and what the vehicle in it can do.
struct PathSearch {
  double dt = 0.4;               ///< of a move [s]
  double clearance = 2.5;        ///< kept between the vehicle's footprint and obstacles [m]
  double v_min = 3, v_max = 25;  ///< [m/s]
  double acceleration = 1.5;     ///< [m/s^2]
  double braking = 3.5;          ///< [m/s^2]
  double lateral_acceleration =
      4;                    ///< most [m/s^2]; some .5 below where a wheel load falls to 1000 N
  double curvature = 0.15;  ///< most [1/m]
  double curvature_rate = 0.026;  ///< most [1/(m s)]: 5 deg/s of steering on a wheelbase of 3.3 m
  double t_max = 45;              ///< [s]
  int max_places = 150'000;       ///< looked at before the search gives up
};

/// Whether the search finds a way of `vehicle` from the start into the goal, which is a place, past
/// the obstacles where they are by then and within the region: hybrid A* (D. Dolgov, S. Thrun, M.
/// Montemerlo and J. Diebel, "Path planning for autonomous vehicles in unknown semi-structured
/// environments", Int. J. Robotics Research 29(5), 2010) over place, heading, speed, curvature and
/// time. A move holds one rate of curvature and one acceleration; the way is one that a vehicle
/// with these limits and no slip can drive. Its clearance is checked every tenth of a move; discs
/// stand in for obstacles that are not plain and for the vehicle's body. It may deny a way that
/// leads between its grid's points.
bool path_exists(const Environment& environment, const vehicle::Parameters& vehicle,
                 const vehicle::State& start, const PathSearch& search = {});

}  // namespace slalom::world
