#pragma once

#include <optional>
#include <vector>

#include "slalom/base/options.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::sim {

/// How what the planner is told differs from what is; section 4 of docs/formulation.md. The
/// defaults tell the truth. Noise is normal, without bias, and drawn anew in each cycle.
struct SensingSettings {
  double position_noise = 0;  ///< standard deviation of x and of y [m]
  double heading_noise = 0;   ///< of psi [rad]
  double speed_noise = 0;     ///< of ux and of v [m/s]
  double yaw_rate_noise = 0;  ///< of r [rad/s]
  int noise_seed = 0;
  double delay = 0;                     ///< age of the vehicle's state when it is told [s]
  double obstacle_velocity_factor = 1;  ///< believed over true, both components
  double obstacle_position_noise = 0;   ///< of x and of y of each obstacle [m]
};

const OptionTable<SensingSettings>& sensing_options();

/// Measures the vehicle and its obstacles as `settings` say. A measurement depends on its cycle
/// alone, not on those before it: the same seed gives the same bits. Thread-safe.
class Sensors {
 public:
  /// `cg_shift` [m]: how far the true c.g., of which states have the lateral speed, lies ahead of
  /// the one that the planner takes v for.
  Sensors(const SensingSettings& settings, double cg_shift);

  /// What is told of the true `state` in cycle `index`.
  vehicle::State measured(vehicle::State state, int index) const;
  /// Obstacles as believed in cycle `index`: where they are at t0 [s], but for noise, and from
  /// there on at the velocity believed. Nothing where they are believed as
  /// they are.
  std::optional<std::vector<world::Obstacle>> believed(
      const std::vector<world::Obstacle>& obstacles, int index, double t0) const;

 private:
  SensingSettings settings_;
  double cg_shift_;
};

}  // namespace slalom::sim
