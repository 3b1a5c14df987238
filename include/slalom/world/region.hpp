#pragma once

#include <algorithm>
#include <limits>

#include "slalom/base/options.hpp"

namespace slalom::world {

/// Box in which the vehicle's footprint must lie at every node of a plan [m]; infinite sides are
/// absent.
struct Region {
  double x_min = -std::numeric_limits<double>::infinity();
  double x_max = std::numeric_limits<double>::infinity();
  double y_min = -std::numeric_limits<double>::infinity();
  double y_max = std::numeric_limits<double>::infinity();

  /// How far a place is beyond the side that it is farthest beyond [m]; at most 0 within.
  double outside(double x, double y) const {
    return std::max({x_min - x, x - x_max, y_min - y, y - y_max});
  }
  bool contains(double x, double y) const {
    return x >= x_min && x <= x_max && y >= y_min && y <= y_max;
  }
};

/// The registered options of Region. Their range is that of sides that are there: finite.
const OptionTable<Region>& region_options();

}  // namespace slalom::world
