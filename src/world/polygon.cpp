#include "slalom/world/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "slalom/base/error.hpp"

namespace slalom::world {
namespace {

/// Smaller than this share of the square of its size, an area or a turn is none.
constexpr double kFlat = 1e-9;

double distance_to_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double share = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return (p - a - along * share).norm();
}

double doubled_area(const std::vector<Point>& corners) {
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    sum += cross(corners[k] - corners[0], corners[(k + 1) % corners.size()] - corners[0]);
  return sum;
}

/// Outside an edge of `a`, how far the nearest of `b` lies: the greatest over the edges. Positive
/// where an edge parts them.
double parted_by_edges(const std::vector<Point>& a, const std::vector<Point>& b) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Point along = a[(k + 1) % a.size()] - a[k];
    const Point outward = Point{along.y, -along.x} * (1 / along.norm());
    double least = std::numeric_limits<double>::infinity();
    for (const Point& p : b) least = std::min(least, dot(p - a[k], outward));
    most = std::max(most, least);
  }
  return most;
}

double nearest_corner(const std::vector<Point>& corners, const std::vector<Point>& edges) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point& p : corners)
    for (std::size_t k = 0; k < edges.size(); ++k)
      least = std::min(least, distance_to_segment(p, edges[k], edges[(k + 1) % edges.size()]));
  return least;
}

}  // namespace

Polygon::Polygon(std::vector<Point> corners, const std::string& where)
    : corners_(std::move(corners)) {
  const std::size_t n = corners_.size();
  if (n < 3)
    throw InvalidValue(where, fmt::format("a polygon with {} corners", n), "three or more");
  for (std::size_t k = 0; k < n; ++k) {
    if (!std::isfinite(corners_[k].x) || !std::isfinite(corners_[k].y))
      throw InvalidValue(where, fmt::format("a corner {} that is not finite", k + 1),
                         "finite numbers");
    reach_ = std::max(reach_, corners_[k].norm());
  }
  double size = 0;
  for (const Point& p : corners_) size = std::max(size, (p - corners_[0]).norm());
  const double doubled = doubled_area(corners_);
  if (!(std::fabs(doubled) > kFlat * size * size))
    throw InvalidValue(where, "a polygon of no area", "corners that are not on one line");
  if (doubled < 0) std::reverse(corners_.begin(), corners_.end());
  double turned = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Point in = corners_[k] - corners_[(k + n - 1) % n],
                out = corners_[(k + 1) % n] - corners_[k];
    const bool still = dot(in, in) == 0 || dot(out, out) == 0;
    if (still || cross(in, out) < -kFlat * size * size)
      throw InvalidValue(where,
                         fmt::format("a polygon that is not convex at ({:.6g}, {:.6g})",
                                     corners_[k].x, corners_[k].y),
                         still ? "corners at places of their own"
                               : "a convex one; several convex ones may cover it");
    turned += std::atan2(cross(in, out), dot(in, out));
  }
  if (turned > 7)  // more than one turn
    throw InvalidValue(where, "a polygon that crosses itself", "a convex one");
}

Polygon Polygon::rectangle(double length, double width, Point middle) {
  const double l = length / 2, w = width / 2;
  return {{{middle.x + l, middle.y + w},
           {middle.x - l, middle.y + w},
           {middle.x - l, middle.y - w},
           {middle.x + l, middle.y - w}},
          "rectangle"};
}

double Polygon::area() const {
  return doubled_area(corners_) / 2;
}

double Polygon::width() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Point along = corners_[(k + 1) % corners_.size()] - corners_[k];
    double most = 0;
    for (const Point& p : corners_) most = std::max(most, cross(along, p - corners_[k]));
    least = std::min(least, most / along.norm());
  }
  return least;
}

double Polygon::distance(Point p) const {
  return signed_distance(p, corners_);
}

double signed_distance(Point p, const std::vector<Point>& corners) {
  double least = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point a = corners[k], b = corners[(k + 1) % corners.size()];
    inside = inside && cross(b - a, p - a) >= 0;
    least = std::min(least, distance_to_segment(p, a, b));
  }
  return inside ? -least : least;
}

double distance(const std::vector<Point>& a, const std::vector<Point>& b) {
  const double parted = std::max(parted_by_edges(a, b), parted_by_edges(b, a));
  if (parted <= 0) return parted;
  return std::min(nearest_corner(a, b), nearest_corner(b, a));
}

}  // namespace slalom::world
