#pragma once

#include <string>
#include <vector>

#include "slalom/world/pose.hpp"

namespace slalom::world {

/// A convex polygon [m], its corners counter-clockwise. Immutable.
class Polygon {
 public:
  /// From corners in either sense. Throws InvalidValue, naming `where`, for fewer than three
  /// corners, numbers that are not finite, no area, and a polygon that is not convex.
  Polygon(std::vector<Point> corners, const std::string& where);
  /// Of `length` along x and `width` along y, about `middle`.
  static Polygon rectangle(double length, double width, Point middle = {});

  const std::vector<Point>& corners() const { return corners_; }
  /// Least radius about the origin of a circle that covers it.
  double reach() const { return reach_; }
  double area() const;
  /// Of the narrowest strip that holds it.
  double width() const;

  /// Signed Euclidean distance from a point to the edge: negative inside.
  double distance(Point p) const;

 private:
  std::vector<Point> corners_;
  double reach_ = 0;
};

/// Signed Euclidean distance from a point to the edge of a convex polygon, whose corners are
/// counter-clockwise: negative inside.
double signed_distance(Point p, const std::vector<Point>& corners);

/// Euclidean distance between two convex polygons in one frame; where they overlap, minus the
/// length of the shortest move that parts them (by the edges' normals; the separating axis theorem:
/// C. Ericson, "Real-time collision detection", 2005, section 5.2).
double distance(const std::vector<Point>& a, const std::vector<Point>& b);

}  // namespace slalom::world
