#pragma once

#include <string>

#include "slalom/base/options.hpp"

namespace slalom::world {

/// An axis-aligned ellipse moving at constant velocity: centre (x + vx t, y + vy t) at absolute
/// time t [s], semi-axes a along x and b along y [m].
struct Obstacle {
  std::string name;
  double x = 0, y = 0;    ///< centre at t = 0 [m]
  double a = 1, b = 1;    ///< semi-axes [m]
  double vx = 0, vy = 0;  ///< [m/s]

  double x_at(double t) const { return x + vx * t; }
  double y_at(double t) const { return y + vy * t; }
  bool moves() const { return vx != 0 || vy != 0; }
  /// The ellipse whose semi-axes are longer by `margin` [m]: what a safety margin makes of it.
  Obstacle grown(double margin) const {
    Obstacle result = *this;
    result.a += margin;
    result.b += margin;
    return result;
  }
};

/// The registered options of Obstacle, with unit, range and meaning.
const OptionTable<Obstacle>& obstacle_options();

/// Signed Euclidean distance [m] from the point (x, y) to the obstacle's edge at absolute time t
/// [s], negative inside; as exact as signed_distance_to_ellipse.
double distance(const Obstacle& obstacle, double x, double y, double t);

}  // namespace slalom::world
