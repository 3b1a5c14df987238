#pragma once

#include <algorithm>
#include <cmath>

#include "slalom/base/options.hpp"

namespace slalom::world {

/// Goal position [m], direction through it psi [rad] and half-width sigma [m] of the square within
/// which the front axle's centre has arrived.
struct Goal {
  double x = 0, y = 0;
  double psi = 1.5707963267948966;
  double sigma = 15;

  /// How far (px, py) lies outside the square, in the norm whose ball the square is [m]; negative
  /// inside.
  double outside(double px, double py) const {
    return std::max(std::abs(px - x), std::abs(py - y)) - sigma;
  }
  bool contains(double px, double py) const {
    return std::abs(px - x) <= sigma && std::abs(py - y) <= sigma;
  }
};

/// The registered options of Goal, with unit, range and meaning.
const OptionTable<Goal>& goal_options();

}  // namespace slalom::world
