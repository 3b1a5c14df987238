#include "slalom/world/region.hpp"

namespace slalom::world {

const OptionTable<Region>& region_options() {
  static const auto table = [] {
    const auto any = OptionRange::any();
    OptionTable<Region> t;
    t.real("x_min", &Region::x_min, any, "m",
           "West side of the box a plan stays in; none if left out.")
        .real("x_max", &Region::x_max, any, "m", "East side; none if left out.")
        .real("y_min", &Region::y_min, any, "m", "South side; none if left out.")
        .real("y_max", &Region::y_max, any, "m", "North side; none if left out.");
    return t;
  }();
  return table;
}

}  // namespace slalom::world
