#pragma once

#include <limits>

#include "slalom/base/options.hpp"

namespace slalom::world {

/// Box in which every node of a plan must lie [m]; infinite sides are absent.
struct Region {
  double x_min = -std::numeric_limits<double>::infinity();
  double x_max = std::numeric_limits<double>::infinity();
  double y_min = -std::numeric_limits<double>::infinity();
  double y_max = std::numeric_limits<double>::infinity();

  bool contains(double x, double y) const {
    return x >= x_min && x <= x_max && y >= y_min && y <= y_max;
  }
};

/// The registered options of Region. Their range is that of sides that are there: finite.
const OptionTable<Region>& region_options();

}  // namespace slalom::world
