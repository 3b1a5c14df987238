#pragma once

#include <limits>

namespace slalom::planner {

/// Goal position [m], direction through it psi [rad] and half-width sigma [m] of the square within
/// which the front axle's centre has arrived.
struct Goal {
  double x = 0, y = 0;
  double psi = 1.5707963267948966;
  double sigma = 15;
};

/// Box in which every node of a plan must lie [m]; infinite sides are absent.
struct Region {
  double x_min = -std::numeric_limits<double>::infinity();
  double x_max = std::numeric_limits<double>::infinity();
  double y_min = -std::numeric_limits<double>::infinity();
  double y_max = std::numeric_limits<double>::infinity();
};

}  // namespace slalom::planner
