#pragma once

#include <string>

namespace slalom::planner {

/// An axis-aligned ellipse moving at constant velocity: centre (x + vx t, y + vy t) at absolute
/// time t [s], semi-axes a along x and b along y [m].
struct Obstacle {
  std::string name;
  double x = 0, y = 0;    ///< centre at t = 0 [m]
  double a = 1, b = 1;    ///< semi-axes [m]
  double vx = 0, vy = 0;  ///< [m/s]

  double x_at(double t) const { return x + vx * t; }
  double y_at(double t) const { return y + vy * t; }
};

}  // namespace slalom::planner
