#include "slalom/world/goal.hpp"

namespace slalom::world {

const OptionTable<Goal>& goal_options() {
  static const auto table = [] {
    const auto any = OptionRange::any();
    OptionTable<Goal> t;
    t.real("x", &Goal::x, any, "m", "East position of the goal.")
        .real("y", &Goal::y, any, "m", "North position of the goal.")
        .real("psi", &Goal::psi, any, "rad", "Direction of the line through the goal to keep to.")
        .real("sigma", &Goal::sigma, OptionRange::positive(), "m",
              "Half-width of the square around the goal; within it the vehicle has arrived.");
    return t;
  }();
  return table;
}

}  // namespace slalom::world
