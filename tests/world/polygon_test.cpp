#include "slalom/world/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "slalom/base/error.hpp"

namespace slalom::world {
namespace {

/// Corners on an ellipse about `middle`, at angles at random.
std::vector<Point> random_polygon(std::mt19937& draw, Point middle) {
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi), size(0.3, 3);
  const double a = size(draw), b = size(draw), turn = angle(draw);
  std::vector<double> angles(3 + draw() % 5);
  for (double& one : angles) one = angle(draw);
  std::sort(angles.begin(), angles.end());
  std::vector<Point> corners;
  for (const double one : angles)
    corners.push_back(
        Pose{middle.x, middle.y, turn}.to_world({a * std::cos(one), b * std::sin(one)}));
  return corners;
}

/// Points along the edges, no two neighbours farther apart than `step`.
std::vector<Point> along_edges(const std::vector<Point>& corners, double step) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point from = corners[k], along = corners[(k + 1) % corners.size()] - from;
    const double count = std::ceil(along.norm() / step);
    for (double i = 0; i < count; ++i) points.push_back(from + along * (i / count));
  }
  return points;
}

double nearest(const std::vector<Point>& points, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point& q : points) least = std::min(least, (p - q).norm());
  return least;
}

TEST(Polygon, DistanceToAPointIsThatOfADenseSearch) {
  std::mt19937 draw(7);
  std::uniform_real_distribution<double> place(-5, 5);
  for (int i = 0; i < 60; ++i) {
    const Polygon polygon(random_polygon(draw, {0.3, -0.2}), "test");
    const auto edge = along_edges(polygon.corners(), 1e-3);
    for (int j = 0; j < 5; ++j) {
      const Point p{place(draw), place(draw)};
      EXPECT_NEAR(std::fabs(polygon.distance(p)), nearest(edge, p), 1e-3);
    }
    Point inside;
    for (const Point& corner : polygon.corners())
      inside = inside + corner * (1 / static_cast<double>(polygon.corners().size()));
    EXPECT_LT(polygon.distance(inside), 0);
  }
}

TEST(Polygon, DistanceOfTwoIsThatOfADenseSearch) {
  std::mt19937 draw(8);
  std::uniform_real_distribution<double> place(-4, 4);
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 200; ++i) {
    const Polygon a(random_polygon(draw, {}), "a");
    const Polygon b(random_polygon(draw, {place(draw), place(draw)}), "b");
    const double d = distance(a.corners(), b.corners());
    EXPECT_NEAR(d, distance(b.corners(), a.corners()), 1e-12);
    const auto edge_a = along_edges(a.corners(), 0.01), edge_b = along_edges(b.corners(), 0.01);
    double least = std::numeric_limits<double>::infinity();
    for (const Point& p : edge_b) least = std::min(least, a.distance(p));
    for (const Point& p : edge_a) least = std::min(least, b.distance(p));
    EXPECT_EQ(d < 0, least < 0) << d << " " << least;
    if (d > 0) EXPECT_NEAR(d, least, 0.01);
    ++(d < 0 ? overlapping : apart);
  }
  EXPECT_GT(apart, 40);
  EXPECT_GT(overlapping, 40);
}

TEST(Polygon, ClosedForms) {
  const auto box = Polygon::rectangle(4, 2);
  EXPECT_DOUBLE_EQ(box.area(), 8);
  EXPECT_DOUBLE_EQ(box.width(), 2);
  EXPECT_DOUBLE_EQ(box.reach(), std::sqrt(5));
  EXPECT_DOUBLE_EQ(box.distance({5, 5}), 5);
  EXPECT_DOUBLE_EQ(box.distance({1.5, 0.25}), -0.5);
  EXPECT_DOUBLE_EQ(distance(box.corners(), Polygon::rectangle(2, 2, {6, 5}).corners()),
                   std::hypot(3, 3));
  // Where they overlap: the shortest move that parts them.
  EXPECT_DOUBLE_EQ(distance(box.corners(), Polygon::rectangle(2, 2, {2.5, 0.5}).corners()), -0.5);
  EXPECT_DOUBLE_EQ(distance(box.corners(), Polygon::rectangle(0.5, 0.5).corners()), -1.25);
  EXPECT_DOUBLE_EQ(Polygon({{0, 0}, {2, 0}, {0, 2}}, "").width(), std::sqrt(2));
}

TEST(Polygon, CornersInEitherSense) {
  const Polygon clockwise({{0, 0}, {0, 2}, {3, 0}}, "test");
  EXPECT_GT(clockwise.area(), 0);
  EXPECT_LT(clockwise.distance({0.5, 0.5}), 0);
}

std::string refusal(const std::vector<Point>& corners) {
  try {
    const Polygon polygon(corners, "there");
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Polygon, WhatIsNoneIsRefused) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal({{0, 0}, {1, 0}}),
            "there: found a polygon with 2 corners, expected three or more");
  EXPECT_EQ(refusal({{0, 0}, {1, 0}, {0, inf}}),
            "there: found a corner 3 that is not finite, expected finite numbers");
  EXPECT_EQ(refusal({{0, 0}, {1, 1}, {3, 3}}),
            "there: found a polygon of no area, expected corners that are not on one line");
  EXPECT_EQ(refusal({{0, 0}, {4, 0}, {1, 1}, {0, 4}}),
            "there: found a polygon that is not convex at (1, 1), expected a convex one; several "
            "convex ones may cover it");
  EXPECT_EQ(refusal({{0, 0}, {4, 0}, {4, 0}, {0, 4}}),
            "there: found a polygon that is not convex at (4, 0), expected corners at places of "
            "their own");
  std::vector<Point> star;  // turns left at every corner, twice round
  for (const double k : {0., 2., 4., 1., 3.})
    star.push_back({std::cos(k * 0.4 * std::numbers::pi), std::sin(k * 0.4 * std::numbers::pi)});
  EXPECT_EQ(refusal(star), "there: found a polygon that crosses itself, expected a convex one");
}

}  // namespace
}  // namespace slalom::world
