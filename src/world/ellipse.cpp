#include "slalom/world/ellipse.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace slalom::world {
namespace {

/// Eberly's GetRoot: the root s > -1 of (r0 z0/(s + r0))² + (z1/(s + 1))² = 1. The function falls
/// from +inf and is convex there, so bisection down to neighbouring doubles cannot fail.
double closest_point_parameter(double r0, double z0, double z1, double g) {
  const double n0 = r0 * z0;
  double low = z1 - 1;
  double high = g < 0 ? 0 : std::hypot(n0, z1) - 1;
  for (;;) {
    const double s = low + (high - low) / 2;
    if (s <= low || s >= high) return s;
    const double ratio0 = n0 / (s + r0), ratio1 = z1 / (s + 1);
    const double value = ratio0 * ratio0 + ratio1 * ratio1 - 1;
    if (value == 0) return s;
    (value > 0 ? low : high) = s;
  }
}

/// Inside and nearer to the long axis than this share of the short one the root is so near to -1
/// that s + 1 has lost its digits.
constexpr double kNearAxis = 1e-4;

/// The same root as w = s + 1, with all its digits however small it is.
double small_parameter(double r0, double z0, double z1) {
  const double n0 = r0 * z0;
  double low = z1, high = 1;
  for (;;) {
    const double w = low + (high - low) / 2;
    if (w <= low || w >= high) return w;
    const double ratio0 = n0 / (w + (r0 - 1)), ratio1 = z1 / w;
    (ratio0 * ratio0 + ratio1 * ratio1 > 1 ? low : high) = w;
  }
}

/// Unsigned distance in the first quadrant, y0, y1 >= 0, to the ellipse of semi-axes e0 >= e1.
double distance_in_first_quadrant(double e0, double e1, double y0, double y1) {
  if (y1 / e1 > std::numeric_limits<double>::min()) {  // what is nearer is on the axis
    if (y0 == 0) return std::abs(y1 - e1);
    const double z0 = y0 / e0, z1 = y1 / e1;
    const double g = z0 * z0 + z1 * z1 - 1;
    if (g == 0) return 0;
    const double r0 = (e0 / e1) * (e0 / e1);
    if (g < 0 && z1 < kNearAxis) {
      const double w = small_parameter(r0, z0, z1);
      return std::hypot(r0 * y0 / (w + (r0 - 1)) - y0, y1 / w - y1);
    }
    const double s = closest_point_parameter(r0, z0, z1, g);
    return std::hypot(r0 * y0 / (s + r0) - y0, y1 / (s + 1) - y1);
  }
  const double numerator = e0 * y0, denominator = e0 * e0 - e1 * e1;
  if (numerator < denominator) {
    const double ratio = numerator / denominator;
    return std::hypot(e0 * ratio - y0, e1 * std::sqrt(1 - ratio * ratio));
  }
  return std::abs(y0 - e0);
}

}  // namespace

double signed_distance_to_ellipse(double dx, double dy, double a, double b) {
  if (a == b) return std::hypot(dx, dy) - a;
  double e0 = a, e1 = b, y0 = std::abs(dx), y1 = std::abs(dy);
  if (e0 < e1) {
    std::swap(e0, e1);
    std::swap(y0, y1);
  }
  const double distance = distance_in_first_quadrant(e0, e1, y0, y1);
  const double z0 = y0 / e0, z1 = y1 / e1;
  return z0 * z0 + z1 * z1 < 1 ? -distance : distance;
}

}  // namespace slalom::world
