#include "slalom/sim/sensing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "draws.hpp"

namespace slalom::sim {
namespace {

using Range = OptionRange;

/// `value` with noise of standard deviation `sigma`; untouched where there is none.
void disturb(double& value, double sigma, NormalDraws& draws) {
  // Each has a draw of its own: one noise does not change another.
  if (sigma > 0)
    value += sigma * draws.next();
  else
    draws.skip();
}

}  // namespace

const OptionTable<SensingSettings>& sensing_options() {
  using S = SensingSettings;
  static const auto table = [] {
    // Far beyond what anyone measures by; what a planner cannot take of it ends a drive.
    const auto place = Range::closed(0, 1e6), angle = Range::closed(0, 100);
    const auto speed = Range::closed(0, 1e3);
    OptionTable<SensingSettings> options;
    options
        .real("position_noise", &S::position_noise, place, "m",
              "Standard deviation of the vehicle's measured x, and of y.")
        .real("heading_noise", &S::heading_noise, angle, "rad",
              "Standard deviation of the measured psi.")
        .real("speed_noise", &S::speed_noise, speed, "m/s",
              "Standard deviation of the measured ux, and of v.")
        .real("yaw_rate_noise", &S::yaw_rate_noise, angle, "rad/s",
              "Standard deviation of the measured r.")
        .integer("noise_seed", &S::noise_seed, Range::closed(0, 2147483647), "1",
                 "Of all noise, which is drawn once a cycle: the same seed gives the same drive.")
        .real("delay", &S::delay, Range::closed(0, 10), "s",
              "Age of the vehicle's measured state, which the planner takes for the present one; "
              "until then it is told the state at the start.")
        .real("obstacle_velocity_factor", &S::obstacle_velocity_factor, Range::closed(-1e3, 1e3),
              "1",
              "Believed over true velocity of obstacles; those that move by a table or a path are "
              "believed to go through it so much faster. Where they are when planning begins is "
              "measured right, so the error grows with time from there.")
        .real("obstacle_position_noise", &S::obstacle_position_noise, place, "m",
              "Standard deviation of the measured x, and of y, of each obstacle.");
    return options;
  }();
  return table;
}

Sensors::Sensors(const SensingSettings& settings, double cg_shift)
    : settings_(settings), cg_shift_(cg_shift) {}

vehicle::State Sensors::measured(vehicle::State state, int index) const {
  using namespace vehicle;
  // Lateral speed of the point that is believed to be the c.g., `cg_shift` behind it.
  if (cg_shift_ != 0) state[V] -= cg_shift_ * state[R];
  NormalDraws draws{static_cast<std::uint32_t>(settings_.noise_seed),
                    static_cast<std::uint32_t>(index), 0};
  disturb(state[X], settings_.position_noise, draws);
  disturb(state[Y], settings_.position_noise, draws);
  disturb(state[PSI], settings_.heading_noise, draws);
  disturb(state[UX], settings_.speed_noise, draws);
  disturb(state[V], settings_.speed_noise, draws);
  disturb(state[R], settings_.yaw_rate_noise, draws);
  return state;
}

std::optional<std::vector<world::Obstacle>> Sensors::believed(
    const std::vector<world::Obstacle>& obstacles, int index, double t0) const {
  if (settings_.obstacle_velocity_factor == 1 && settings_.obstacle_position_noise == 0)
    return std::nullopt;
  auto result = obstacles;
  for (std::uint32_t i = 0; i < result.size(); ++i) {
    auto& o = result[i];
    NormalDraws draws{static_cast<std::uint32_t>(settings_.noise_seed),
                      static_cast<std::uint32_t>(index), i + 1};
    if (o.trajectory) {
      world::Point displacement;
      disturb(displacement.x, settings_.obstacle_position_noise, draws);
      disturb(displacement.y, settings_.obstacle_position_noise, draws);
      if (settings_.obstacle_velocity_factor != 1)
        o.trajectory = std::make_shared<world::RetimedTrajectory>(
            o.trajectory, t0, settings_.obstacle_velocity_factor);
      o.trajectory = std::make_shared<world::MovedTrajectory>(o.trajectory, displacement);
      continue;
    }
    const double x = o.x_at(t0), y = o.y_at(t0);
    o.vx *= settings_.obstacle_velocity_factor;
    o.vy *= settings_.obstacle_velocity_factor;
    o.x = x - o.vx * t0;
    o.y = y - o.vy * t0;
    disturb(o.x, settings_.obstacle_position_noise, draws);
    disturb(o.y, settings_.obstacle_position_noise, draws);
  }
  return result;
}

}  // namespace slalom::sim
