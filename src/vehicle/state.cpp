#include "slalom/vehicle/state.hpp"

namespace slalom::vehicle {

const OptionTable<State>& state_options() {
  static const auto table = [] {
    OptionTable<State> t;
    const auto add = [&](StateIndex index, const char* unit, const char* doc) {
      t.element(kStateNames[index], index, OptionRange::any(), unit, doc);
    };
    add(X, "m", "East position of the front axle's centre.");
    add(Y, "m", "North position of the front axle's centre.");
    add(V, "m/s", "Lateral speed of the centre of gravity, left positive.");
    add(R, "rad/s", "Yaw rate, counter-clockwise positive.");
    add(PSI, "rad", "Heading from +x, counter-clockwise.");
    add(SA, "rad", "Front steering angle, left positive.");
    add(UX, "m/s", "Longitudinal speed.");
    add(AX, "m/s^2", "Longitudinal acceleration.");
    return t;
  }();
  return table;
}

}  // namespace slalom::vehicle
