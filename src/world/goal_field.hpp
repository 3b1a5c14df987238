#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "slalom/world/region.hpp"

namespace slalom::world {

/// Of an obstacle that moves by a trajectory, at the beginning of a move: its place relative to the
/// goal [m], by how much it is larger [m], and whether it is there during the move.
struct Moment {
  double x = 0, y = 0, larger = 0;
  bool there = true;
};

/// An obstacle to a search: place at the search's start relative to the goal [m], velocity [m/s]
/// and semi-axes [m].
struct Ellipse {
  double x = 0, y = 0, vx = 0, vy = 0, a = 1, b = 1;
  std::ptrdiff_t moments = -1;  ///< index of the first of its moments, which override the place

  bool contains(double px, double py) const {
    const double dx = (px - x) / a, dy = (py - y) / b;
    return dx * dx + dy * dy < 1;
  }
};

/// A direction as a frame of coordinates about the goal: u along it, w across, left positive.
struct Frame {
  double c = 1, s = 0;

  double u(double x, double y) const { return c * x + s * y; }
  double w(double x, double y) const { return c * y - s * x; }
  double x(double u, double w) const { return c * u - s * w; }
  double y(double u, double w) const { return s * u + c * w; }
};

/// The length of the shortest path to the goal around the obstacles that stand, from anywhere in a
/// box around start and goal: Dijkstra's algorithm on a square grid in the goal's frame, with 16
/// neighbours. All places are relative to the goal.
class GoalField {
 public:
  /// The goal is |u| <= half_u, |w| <= half_w [m].
  void build(const Frame& frame, double start_x, double start_y, double half_u, double half_w,
             const Region& region, const std::vector<Ellipse>& obstacles);

  /// Length [m] from (u, w) in the frame; outside the box or where no path leads the straight line
  /// and some more.
  double operator()(double u, double w) const {
    const double i = std::floor(u / h_ + 0.5) - i0_, j = std::floor(w / h_ + 0.5) - j0_;
    if (!(i >= 0 && j >= 0 && i < columns_ && j < rows_)) return line(u, w) + 20;
    const float length = length_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                                 static_cast<std::size_t>(i)];
    return length < kFar ? static_cast<double>(length) : line(u, w) + 10;
  }

 private:
  static constexpr float kFar = 1e8F;

  double line(double u, double w) const {
    const double length = std::sqrt(u * u + w * w) - half_u_;
    return length > 0 ? length : 0;
  }
  void place_box(double start_u, double start_w);
  void shut(const Frame& frame, const Region& region, const std::vector<Ellipse>& obstacles);
  void shut(const Frame& frame, const Ellipse& obstacle);
  void spread();

  double h_ = 1, half_u_ = 0;
  int i0_ = 0, j0_ = 0, columns_ = 0, rows_ = 0;
  std::vector<float> length_;  ///< of each cell, row by row
  std::vector<char> shut_;
  std::vector<std::pair<float, int>> open_;  ///< a heap
};

}  // namespace slalom::world
