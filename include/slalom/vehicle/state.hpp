#pragma once

#include <array>
#include <cstddef>

#include "slalom/base/options.hpp"

namespace slalom::vehicle {

/// States of the 3DoF model in their order everywhere: x, y [m] of the front axle's centre, lateral
/// speed v [m/s] and yaw rate r [rad/s] of the c.g., heading psi [rad] from +x counter-clockwise,
/// steering angle sa [rad] left positive, longitudinal speed ux [m/s], acceleration ax [m/s^2].
enum StateIndex : std::size_t { X, Y, V, R, PSI, SA, UX, AX, kStates };
/// Controls: steering rate sr [rad/s], longitudinal jerk jx [m/s^3].
enum ControlIndex : std::size_t { SR, JX, kControls };

using State = std::array<double, kStates>;
using Control = std::array<double, kControls>;

/// Vertical wheel loads [N] in the order of the paper's listings: rear left, rear right, front
/// left, front right.
enum WheelIndex : std::size_t { RL, RR, FL, FR, kWheels };
using WheelLoads = std::array<double, kWheels>;

inline constexpr std::array<const char*, kStates> kStateNames = {"x",   "y",  "v",  "r",
                                                                 "psi", "sa", "ux", "ax"};
inline constexpr std::array<const char*, kControls> kControlNames = {"sr", "jx"};
inline constexpr std::array<const char*, kWheels> kWheelNames = {"Fz_rl", "Fz_rr", "Fz_fl",
                                                                 "Fz_fr"};

/// The registered options of State, by kStateNames, with unit and meaning.
const OptionTable<State>& state_options();

}  // namespace slalom::vehicle
