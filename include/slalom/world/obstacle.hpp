#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "slalom/base/options.hpp"
#include "slalom/world/polygon.hpp"
#include "slalom/world/pose.hpp"
#include "slalom/world/trajectory.hpp"

namespace slalom::world {

/// A body to keep off. Its shape is an ellipse with semi-axes a along its own x axis and b along
/// its y axis [m], or a convex polygon. It moves at constant velocity from (x, y) at t = 0, its
/// axis in the constant direction psi; or as its trajectory says.
struct Obstacle {
  std::string name;
  double x = 0, y = 0;    ///< centre at t = 0 [m]
  double a = 1, b = 1;    ///< semi-axes [m]; of a polygon both the radius that covers it
  double vx = 0, vy = 0;  ///< [m/s]
  double psi = 0;         ///< direction of the body's x axis [rad]
  /// Corners in the body's own frame; none: the ellipse.
  std::shared_ptr<const Polygon> outline = {};
  double rounding = 0;  ///< by which the outline is larger all around [m]
  /// Overrides x, y, vx, vy and psi.
  std::shared_ptr<const Trajectory> trajectory = {};
  double margin_start = 0;  ///< by which predictions take it for larger [m]
  double margin_rate = 0;   ///< and by how much more for each second ahead [m/s]
  double predicted_at = 0;  ///< absolute time from which the seconds ahead count [s]

  double x_at(double t) const { return trajectory ? trajectory->at(t).x : x + vx * t; }
  double y_at(double t) const { return trajectory ? trajectory->at(t).y : y + vy * t; }
  Pose pose_at(double t) const;
  bool moves() const { return trajectory || vx != 0 || vy != 0; }
  /// An ellipse along the axes of x and y at constant velocity: what the paper has.
  bool is_plain() const { return !trajectory && !outline && (psi == 0 || a == b); }
  bool present(double t0, double t1) const { return !trajectory || trajectory->present(t0, t1); }
  /// Corners of the outline in the world's frame; none of an ellipse.
  std::vector<Point> corners_at(double t) const;
  /// What no point of the body is faster than from t0 to t1 [m/s].
  double fastest(double t0, double t1) const;
  /// By how much a prediction takes it for larger at t [m].
  double margin(double t) const {
    return margin_start + margin_rate * std::max(t - predicted_at, 0.0);
  }
  /// Radius about its point of reference of a circle that covers it [m], without margins.
  double reach() const { return std::max(a, b) + rounding; }
  /// The body larger by `margin` [m]: an ellipse's semi-axes are longer, a polygon is so far off.
  Obstacle grown(double margin) const;
};

/// The registered options of Obstacle, with unit, range and meaning.
const OptionTable<Obstacle>& obstacle_options();

/// Signed Euclidean distance [m] from the point (x, y) to the obstacle's edge at absolute time t
/// [s], negative inside; exact to rounding. Where it is absent, to where it would be.
double distance(const Obstacle& obstacle, double x, double y, double t);

/// Euclidean distance [m] between a convex polygon, whose corners are in the world's frame, and the
/// obstacle at absolute time t [s]; negative where they overlap.
double distance(const Obstacle& obstacle, const std::vector<Point>& polygon, double t);

/// The rectangle about the body's outline or ellipse along its own axes, cut across its longer side
/// into so many of one size: each with its point of reference in its middle, as it moves; rounded
/// as the outline is. Named as it is.
std::vector<Obstacle> covering_rectangles(const Obstacle& obstacle, int parts = 1);

/// Circles that cover the body at all times; the body itself where it is plain. Named as it is.
/// They cover the rectangle about a polygon or a turned ellipse by a row along its middle and cells
/// in what that leaves of its corners, and stick out of it by at most `excess` [m], but for no more
/// than `most` of them.
constexpr int kMostDiscs = 16;
std::vector<Obstacle> covering_discs(const Obstacle& obstacle, double excess,
                                     int most = kMostDiscs);

}  // namespace slalom::world
