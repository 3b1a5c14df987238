#include "slalom/world/obstacle.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "slalom/world/ellipse.hpp"

namespace slalom::world {
namespace {

double distance_in_body(const Obstacle& o, Point p) {
  if (!o.outline) return signed_distance_to_ellipse(p.x, p.y, o.a, o.b);
  return o.outline->distance(p) - o.rounding;
}

struct Circle {
  Point centre;
  double radius;
};

/// Circles that cover a rectangle about the origin, its long side along x. A row of one radius
/// along the middle sticks out of sides and ends by `excess` where a circle does so; what it leaves
/// of a corner is a square, covered by cells.
std::vector<Circle> circles_over(double length, double width, double excess) {
  const double half = width / 2, whole = std::hypot(length / 2, half);
  if (whole - half <= excess) return {{{}, whole}};
  const double radius = half + excess, reach = std::sqrt(radius * radius - half * half);
  const double between = length - width;  // the centres of the first and the last
  const double steps = std::ceil(between / (2 * reach) - 1e-9);
  std::vector<Circle> circles;
  for (double k = 0; k <= steps; ++k)
    circles.push_back({{steps > 0 ? between * (k / steps - 0.5) : 0, 0}, radius});
  const double corner = half - reach;
  const double cells = std::ceil(corner * (std::numbers::sqrt2 - 1) / 2 / excess - 1e-9);
  const double cell = corner / cells;
  for (double i = 0; i < cells; ++i)
    for (double j = 0; j < cells; ++j) {
      const double in_x = (i + 0.5) * cell, in_y = (j + 0.5) * cell;  // from the corner
      if (std::hypot(half - i * cell, half - j * cell) > radius)
        for (const double x : {length / 2 - in_x, in_x - length / 2})
          for (const double y : {half - in_y, in_y - half})
            circles.push_back({{x, y}, cell / std::numbers::sqrt2});
    }
  return circles;
}

/// The rectangle about an outline or an ellipse along its own axes, in its own frame.
struct Extent {
  Point least, most;

  explicit Extent(const Obstacle& o) : least{-o.a, -o.b}, most{o.a, o.b} {
    if (!o.outline) return;
    least = most = o.outline->corners().front();
    for (const Point& p : o.outline->corners()) {
      least = {std::min(least.x, p.x), std::min(least.y, p.y)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y)};
    }
  }
  Point middle() const { return {(least.x + most.x) / 2, (least.y + most.y) / 2}; }
  double along_x() const { return most.x - least.x; }
  double along_y() const { return most.y - least.y; }
};

/// The obstacle with its point of reference at another one of its own frame.
Obstacle moved_to(const Obstacle& obstacle, Point at) {
  Obstacle result = obstacle;
  if (obstacle.trajectory) {
    result.trajectory = std::make_shared<OffsetTrajectory>(obstacle.trajectory, at);
  } else {
    const Point place = obstacle.pose_at(0).to_world(at);
    result.x = place.x;
    result.y = place.y;
  }
  return result;
}

/// Least signed distance to a convex body along the segment, along which it is convex.
double distance_along(const Obstacle& o, Point from, Point to) {
  const auto at = [&](double share) { return distance_in_body(o, from + (to - from) * share); };
  std::uintmax_t iterations = 60;
  const double inside = boost::math::tools::brent_find_minima(at, 0., 1., 40, iterations).second;
  return std::min({at(0), at(1), inside});
}

}  // namespace

const OptionTable<Obstacle>& obstacle_options() {
  static const auto table = [] {
    const auto any = OptionRange::any();
    OptionTable<Obstacle> t;
    t.text("name", &Obstacle::name,
           "Name in messages and on the command line; O1, O2, ... if left out.")
        .real("x", &Obstacle::x, any, "m", "East position of the centre at t = 0.")
        .real("y", &Obstacle::y, any, "m", "North position of the centre at t = 0.")
        .real("a", &Obstacle::a, OptionRange::positive(), "m", "Semi-axis along x.")
        .real("b", &Obstacle::b, OptionRange::positive(), "m", "Semi-axis along y.")
        .real("vx", &Obstacle::vx, any, "m/s", "Constant speed eastward.")
        .real("vy", &Obstacle::vy, any, "m/s", "Constant speed northward.")
        .real("psi", &Obstacle::psi, any, "rad",
              "Direction of the body's own x axis: an ellipse's a, a box's length, a polygon's x.")
        .real("margin_start", &Obstacle::margin_start, OptionRange::non_negative(), "m",
              "What predictions take the obstacle to be larger by all around, at the moment of "
              "planning.")
        .real("margin_rate", &Obstacle::margin_rate, OptionRange::non_negative(), "m/s",
              "And by how much more for each second ahead, for a prediction that is uncertain.");
    return t;
  }();
  return table;
}

Pose Obstacle::pose_at(double t) const {
  if (trajectory) return trajectory->at(t);
  return {x + vx * t, y + vy * t, psi, vx, vy, 0};
}

std::vector<Point> Obstacle::corners_at(double t) const {
  std::vector<Point> corners;
  if (!outline) return corners;
  const Pose pose = pose_at(t);
  for (const Point& p : outline->corners()) corners.push_back(pose.to_world(p));
  return corners;
}

double Obstacle::fastest(double t0, double t1) const {
  if (!trajectory) return std::hypot(vx, vy);
  const Rates rates = trajectory->fastest(t0, t1);
  return rates.speed + rates.omega * reach();
}

Obstacle Obstacle::grown(double margin) const {
  Obstacle result = *this;
  result.a += margin;
  result.b += margin;
  if (outline) result.rounding += margin;
  return result;
}

double distance(const Obstacle& obstacle, double x, double y, double t) {
  if (obstacle.is_plain())
    return signed_distance_to_ellipse(x - obstacle.x_at(t), y - obstacle.y_at(t), obstacle.a,
                                      obstacle.b);
  return distance_in_body(obstacle, obstacle.pose_at(t).to_body({x, y}));
}

double distance(const Obstacle& obstacle, const std::vector<Point>& polygon, double t) {
  const Pose pose = obstacle.pose_at(t);
  std::vector<Point> corners;
  for (const Point& p : polygon) corners.push_back(pose.to_body(p));
  if (obstacle.outline) return distance(corners, obstacle.outline->corners()) - obstacle.rounding;
  if (obstacle.a == obstacle.b) return signed_distance({}, corners) - obstacle.a;
  double least = std::numeric_limits<double>::infinity();
  bool holds_centre = true;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point a = corners[k], b = corners[(k + 1) % corners.size()];
    least = std::min(least, distance_along(obstacle, a, b));
    holds_centre = holds_centre && cross(b - a, Point{} - a) >= 0;
  }
  // A polygon about the whole ellipse is nowhere inside it.
  return holds_centre ? std::min(least, -std::min(obstacle.a, obstacle.b)) : least;
}

std::vector<Obstacle> covering_rectangles(const Obstacle& obstacle, int parts) {
  const Extent extent(obstacle);
  Point size{extent.along_x(), extent.along_y()};
  const Point across = size.x >= size.y ? Point{size.x / parts, 0} : Point{0, size.y / parts};
  (size.x >= size.y ? size.x : size.y) /= parts;
  const auto outline = std::make_shared<Polygon>(Polygon::rectangle(size.x, size.y));
  std::vector<Obstacle> result;
  for (int k = 0; k < parts; ++k) {
    auto& part =
        result.emplace_back(moved_to(obstacle, extent.middle() + across * (k - 0.5 * (parts - 1))));
    part.outline = outline;
    part.a = part.b = outline->reach();
  }
  return result;
}

std::vector<Obstacle> covering_discs(const Obstacle& obstacle, double excess, int most) {
  if (obstacle.is_plain() || (!obstacle.outline && obstacle.a == obstacle.b)) return {obstacle};
  const Extent extent(obstacle);
  const Point middle = extent.middle();
  const bool along_x = extent.along_x() >= extent.along_y();
  const double length = std::max(extent.along_x(), extent.along_y());
  const double width = std::min(extent.along_x(), extent.along_y());
  auto circles = circles_over(length, width, excess);
  for (; circles.size() > static_cast<std::size_t>(most);
       circles = circles_over(length, width, excess))
    excess *= 1.2;
  std::vector<Obstacle> result;
  for (const auto& [centre, radius] : circles) {
    const Point at = middle + (along_x ? centre : Point{-centre.y, centre.x});
    Obstacle disc = moved_to(obstacle, at);
    disc.outline = nullptr;
    disc.a = disc.b = radius + obstacle.rounding;
    disc.rounding = 0;
    disc.psi = 0;
    result.push_back(std::move(disc));
  }
  return result;
}

}  // namespace slalom::world
