#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/environment.hpp"

namespace slalom::world {

/// A moment of a way, of the front axle's centre.
struct WayPoint {
  double t = 0;         ///< absolute time [s]
  double x = 0, y = 0;  ///< [m]
  double heading = 0;   ///< of its motion [rad]
  double v = 0;         ///< speed [m/s]
  double kappa = 0;     ///< curvature, left positive [1/m]
  double a = 0;         ///< acceleration on the way there [m/s^2]
};

/// Moments .05 s apart, the first being the start.
using Way = std::vector<WayPoint>;

/// What a way may be like, and how long to look for one.
struct WaySearch {
  double clearance = 0.8;             ///< kept from the obstacles as they are given [m]
  double v_min = 1.5, v_max = 28;     ///< [m/s]
  double lateral_acceleration = 3.2;  ///< most [m/s^2]
  double curvature = 0.15;            ///< most [1/m]
  double curvature_rate = 0.024;      ///< most [1/(m s)]
  double braking = 3.3;               ///< [m/s^2]
  double acceleration_share = 0.9;    ///< of the vehicle's ax_max at that speed
  double t_max = 60;                  ///< longest way [s]
  double greed = 2;                   ///< how much more the way ahead counts than the one so far
  int max_places = 150'000;           ///< looked at before the search gives up
};

/// Finds ways in place and time from a state to the goal's square, past obstacles that move at
/// constant velocity: hybrid A* (D. Dolgov, S. Thrun, M. Montemerlo and J. Diebel, "Path planning
/// for autonomous vehicles in unknown semi-structured environments", Int. J. Robotics Research
/// 29(5), 2010) over place, heading, speed, curvature and time. A move of .4 s holds one rate of
/// curvature and one acceleration; places are ranked by time, and by the distance left around what
/// stands still. The same input gives the same way; memory is kept from search to search. Not
/// thread-safe.
class WayFinder {
 public:
  /// Of the environment, goal and region; the obstacles are those of each search.
  WayFinder(const Environment& environment, const vehicle::Parameters& vehicle);
  ~WayFinder();

  /// A way from `start` at t_start [s]; none where the search ends without one, by max_places or
  /// because `over`, polled now and then, says so. An obstacle in which the start lies is left out
  /// until the way has left it.
  std::optional<Way> find(const vehicle::State& start, double t_start,
                          const std::vector<Obstacle>& obstacles, const WaySearch& search,
                          const std::function<bool()>& over = {});
  /// Places that the last search looked at.
  int looked_at() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::world
