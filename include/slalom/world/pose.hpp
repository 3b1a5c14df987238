#pragma once

#include <cmath>

namespace slalom::world {

/// A place [m], or a vector between two, east and north.
struct Point {
  double x = 0, y = 0;

  Point operator+(Point o) const { return {x + o.x, y + o.y}; }
  Point operator-(Point o) const { return {x - o.x, y - o.y}; }
  Point operator*(double s) const { return {x * s, y * s}; }
  double norm() const { return std::hypot(x, y); }
};

inline double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
/// Positive where b lies to the left of a.
inline double cross(Point a, Point b) {
  return a.x * b.y - a.y * b.x;
}

/// Where a body is and how it moves: its point of reference [m], the direction psi of its own x
/// axis [rad] from +x counter-clockwise, the point's velocity [m/s] and the turn rate omega
/// [rad/s].
struct Pose {
  double x = 0, y = 0, psi = 0;
  double vx = 0, vy = 0, omega = 0;

  /// A place of the world in the body's own frame, and back.
  Point to_body(Point p) const {
    const double c = std::cos(psi), s = std::sin(psi), dx = p.x - x, dy = p.y - y;
    return {c * dx + s * dy, c * dy - s * dx};
  }
  Point to_world(Point p) const {
    const double c = std::cos(psi), s = std::sin(psi);
    return {x + c * p.x - s * p.y, y + s * p.x + c * p.y};
  }
};

}  // namespace slalom::world
