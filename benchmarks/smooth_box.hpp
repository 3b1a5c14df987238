#pragma once

#include <cmath>

#include "slalom/ocp/problem.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::bench {

/// The vehicle's body to a row of an OCP: the distance from a place to its rectangle made smooth.
/// One row does for a disc of an obstacle, where discs of the vehicle would take several, and it is
/// closer to the body.
///
/// With the place (u, v) in the rectangle's middle, l and w its half sides and e the smoothing, of
/// f(z, h) = (q + sqrt(q^2 + e^2)) / 2, q = sqrt(z^2 + e^2) - h, which is above max(|z| - h, 0),
/// the distance is sqrt(f(u, l)^2 + f(v, w)^2).
class SmoothBox {
 public:
  /// Of a footprint that is not a point; smoother where the stand-ins of shapes may stick out by
  /// more [m].
  SmoothBox(const world::Footprint& footprint, double cover_excess);

  /// The square of the distance to (dx, dy) from the front axle's centre, which the vehicle's
  /// heading is psi at.
  ocp::Expr square_of_distance(const ocp::Expr& dx, const ocp::Expr& dy,
                               const ocp::Expr& psi) const;
  /// What the smooth distance must be for the true one to be `radius` [m].
  double smooth_radius(double radius) const;

 private:
  double middle_, half_length_, half_width_;
  double smoothing_;  ///< e [m]
};

}  // namespace slalom::bench
