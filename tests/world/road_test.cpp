#include "slalom/world/road.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "slalom/base/error.hpp"

namespace slalom::world {
namespace {

constexpr double kPi = std::numbers::pi;

Road circle(double radius, double right, double left, int points = 24) {
  std::vector<RoadPoint> line;
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * kPi * k / points;
    line.push_back({radius * std::cos(angle), radius * std::sin(angle), right, left});
  }
  return {line, true, {}, "circle"};
}

/// Goes east, turns about by a bend of radius 15 m, and comes back 30 m to the north.
std::vector<RoadPoint> hairpin(double width) {
  std::vector<RoadPoint> line;
  for (double x = 0; x < 80; x += 10) line.push_back({x, 0, width, width});
  for (double angle = -kPi / 2; angle < kPi / 2 + 0.01; angle += kPi / 8)
    line.push_back({80 + 15 * std::cos(angle), 15 + 15 * std::sin(angle), width, width});
  for (double x = 70; x >= 0; x -= 10) line.push_back({x, 30, width, width});
  return line;
}

Road winding() {
  std::vector<RoadPoint> line;
  for (double x = 0; x <= 200; x += 8)
    line.push_back({x, 12 * std::sin(x / 25), 3 + std::sin(x / 30), 4 + std::cos(x / 20)});
  return {line, false, {}, "winding"};
}

std::vector<Point> body(Point at, double psi, double length, double width) {
  const Pose pose{at.x, at.y, psi};
  std::vector<Point> corners;
  for (const Point& p : {Point{length / 2, width / 2}, Point{-length / 2, width / 2},
                         Point{-length / 2, -width / 2}, Point{length / 2, -width / 2}})
    corners.push_back(pose.to_world(p));
  return corners;
}

TEST(Road, GoesThroughItsPointsByArcLengthWithItsWidths) {
  const Road road = circle(40, 3, 4);
  EXPECT_NEAR(road.length(), 2 * kPi * 40, 2e-3);
  const RoadPlace quarter = road.at(road.length() / 4);
  EXPECT_NEAR(quarter.x, 0, 1e-6);
  EXPECT_NEAR(quarter.y, 40, 1e-6);
  EXPECT_NEAR(std::remainder(quarter.psi - kPi, 2 * kPi), 0, 1e-6);
  EXPECT_NEAR(quarter.curvature, 1 / 40., 1e-3);
  EXPECT_EQ(quarter.right, 3);
  EXPECT_EQ(quarter.left, 4);
  EXPECT_EQ(road.narrowest(), 7);
  // A lap more is the same place.
  EXPECT_NEAR(road.at(quarter.s + road.length()).x, quarter.x, 1e-9);
}

TEST(Road, CurvatureIsContinuousAndPeriodic) {
  for (const Road& road : {circle(40, 3, 4, 7), winding()}) {
    double before = road.at(0).curvature;
    for (double s = 0; s <= road.length(); s += 0.01) {
      const double now = road.at(s).curvature;
      ASSERT_LT(std::fabs(now - before), 1e-3) << s;
      before = now;
    }
    if (road.closed()) EXPECT_NEAR(road.at(0).curvature, road.at(road.length()).curvature, 1e-9);
  }
}

TEST(Road, ArcLengthIsLength) {
  const Road road = winding();
  Point before = road.at(0).point();
  double length = 0;
  for (int k = 1; k <= 200000; ++k) {
    const Point p = road.at(road.length() * k / 200000).point();
    length += (p - before).norm();
    before = p;
  }
  EXPECT_NEAR(length, road.length(), 1e-6);
}

TEST(Road, ProjectsAsBruteForceDoes) {
  const Road road = winding();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> s(0, road.length()), n(-8, 8);
  for (int k = 0; k < 300; ++k) {
    const RoadPlace place = road.at(s(random));
    const Point p = place.point() + place.aside() * n(random);
    double least = 1e9;
    for (double at = 0; at <= road.length(); at += 0.02)
      least = std::min(least, (road.at(at).point() - p).norm());
    const OnRoad on = road.project(p);
    EXPECT_LE(std::fabs(on.n), least + 1e-9);
    EXPECT_GE(std::fabs(on.n), std::sqrt(std::max(0., least * least - 0.011 * 0.011)) - 1e-6);
    const RoadPlace foot = road.at(on.s);
    EXPECT_NEAR((foot.point() + foot.aside() * on.n - p).norm(), 0, 1e-8);
  }
}

TEST(Road, GoesOnStraightBeyondItsEnds) {
  const Road road({{0, 0, 2, 3}, {10, 0, 2, 3}, {20, 0, 2, 3}}, false, {}, "straight");
  const OnRoad on = road.project({-7, 1});
  EXPECT_NEAR(on.s, -7, 1e-9);
  EXPECT_NEAR(on.n, 1, 1e-9);
  EXPECT_NEAR(road.project({31, -1}).s, 31, 1e-9);
  EXPECT_NEAR(road.at(31).x, 31, 1e-9);
  EXPECT_NEAR(road.edge_distance({31, -1}), 1, 1e-9);
  for (const double far : {50., 500.})
    for (const double x : {20 + far, -far}) {
      EXPECT_NEAR(road.project({x, -1}).s, x, 1e-9);
      EXPECT_NEAR(road.project({x, -1}).n, -1, 1e-9);
      EXPECT_NEAR(road.edge_distance({x, -1}), 1, 1e-9);
    }
}

TEST(Road, StaysOnItsBranchByAHint) {
  const Road road({hairpin(4)}, false, {}, "hairpin");
  const Point between{20, 16};  // nearer to the way back
  EXPECT_GT(road.project(between).s, 100);
  EXPECT_NEAR(road.project(between, 22).s, 20, 1e-2);
  EXPECT_NEAR(road.project(between, 22).n, 16, 1e-2);
}

TEST(Road, DistanceToAnEdgeIsThatToItsCurve) {
  for (const Road& road : {circle(30, 3, 4), winding()}) {
    const auto left = road.edge(true, 0.01), right = road.edge(false, 0.01);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> s(5, road.length() - 5), n(-2.5, 2.5);
    for (int k = 0; k < 100; ++k) {
      const RoadPlace place = road.at(s(random));
      const Point p = place.point() + place.aside() * n(random);
      double least = 1e9;
      for (const auto* edge : {&left, &right})
        for (const Point& q : *edge) least = std::min(least, (q - p).norm());
      const double found = road.edge_distance(p);
      if (found <= 0) continue;
      EXPECT_LE(found, least + 1e-4);
      EXPECT_GE(found,
                least / std::hypot(1, road.steepest()) / std::hypot(1, road.steepest()) - 1e-2);
    }
  }
  EXPECT_EQ(circle(30, 3, 4).steepest(), 0);
}

TEST(Road, ABodyIsWithinByAllOfItsSides) {
  const Road road = circle(12, 3, 3, 60);
  // Its long side's middle comes nearest to the inner edge of radius 9 m; its outer corners to the
  // outer one of radius 15 m.
  for (const double r : {10.5, 11., 12., 12.5}) {
    const double inner = r - 1 - 9, outer = 15 - std::hypot(r + 1, 2.5);
    const double found = road.edge_distance(body({0, r}, kPi, 5, 2));
    EXPECT_LE(found, std::min(inner, outer) + 1e-3) << r;
    EXPECT_GE(found, std::min(inner, outer) - 2 * Road::kSag) << r;
  }
}

// However close its points are: the sides are looked for by length, not by points.
TEST(Road, ABodyIsWithinARoadOfManyPoints) {
  for (const double apart : {0.02, 0.1, 1., 7.}) {
    std::vector<RoadPoint> line;
    for (double x = 0; x < 100; x += apart) line.push_back({x, 0, 3.5, 3.5});
    const Road road(line, false, {}, "dense");
    EXPECT_NEAR(road.edge_distance(body({50, 0}, 0, 12, 2)), 2.5, 1e-6) << apart;
    EXPECT_NEAR(road.project({50, 0.3}, 40).s, 50, 1e-6) << apart;
  }
}

TEST(Road, MovesWithoutAnyOtherChange) {
  const Road road = winding();
  const auto moved = road.moved({4096, -8192});
  EXPECT_EQ(moved->length(), road.length());
  const OnRoad a = road.project({50, 3}), b = moved->project({4146, -8189});
  EXPECT_NEAR(a.s, b.s, 1e-8);
  EXPECT_NEAR(a.n, b.n, 1e-8);
}

std::string refusal(const std::vector<RoadPoint>& points, bool closed) {
  try {
    const Road road(points, closed, {}, "here");
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "";
}

TEST(Road, RefusesWhatIsNone) {
  const double nan = std::nan("");
  EXPECT_NE(refusal({{0, 0, 2, 2}}, false).find("a road of 1 points"), std::string::npos);
  EXPECT_NE(refusal({{0, 0, 2, 2}, {nan, 0, 2, 2}}, false).find("point 2"), std::string::npos);
  EXPECT_NE(refusal({{0, 0, 2, 2}, {9, 0, 2, 2}, {9, 0, 2, 2}}, false).find("point 2"),
            std::string::npos);
  EXPECT_NE(refusal({{0, 0, 2, 2}, {9, 0, -1, 2}}, false).find("point 2"), std::string::npos);
  EXPECT_NE(refusal({{0, 0, 0, 0}, {9, 0, 1, 2}}, false).find("point 1"), std::string::npos);
  EXPECT_NE(refusal({{0, 0, 1, 1}, {9, 0, 1, 1}, {9, 9, 1, 1}, {0, 0, 1, 1}}, true).find("joins"),
            std::string::npos);
}

TEST(Road, RefusesOneThatTurnsAboutOnTheSpotOrIsBeyondAllMeasure) {
  EXPECT_NE(refusal({{0, 0, 3, 3}, {6, 0, 3, 3}, {0, 0, 3, 3}}, false).find("turns about"),
            std::string::npos);
  EXPECT_NE(refusal({{0, 0, 3, 3}, {6, 0, 3, 3}, {0, 0, 3, 3}, {6, 0, 3, 3}}, true).find("turns"),
            std::string::npos);
  for (const double far : {1e300, -1e10})
    EXPECT_NE(refusal({{0, 0, 2, 2}, {far, 0, 2, 2}}, false).find("up to 1e+09"),
              std::string::npos);
  EXPECT_NE(refusal({{0, 0, 2, 2}, {9, 0, 2, 1e200}}, false).find("point 2"), std::string::npos);
  EXPECT_EQ(refusal({{-9e5, 5.4e6, 2, 2}, {9e5, 5.5e6, 2, 2}}, false), "");
}

TEST(Road, RefusesOneThatComesWithinItsOwnWidthOfItself) {
  EXPECT_EQ(refusal(hairpin(4), false), "");
  EXPECT_EQ(refusal(hairpin(14.5), false), "");
  EXPECT_NE(refusal(hairpin(15.5), false).find("cross itself"), std::string::npos);
  // A figure of eight.
  std::vector<RoadPoint> eight;
  for (int k = 0; k < 40; ++k) {
    const double angle = 2 * kPi * k / 40;
    eight.push_back({60 * std::sin(angle), 40 * std::sin(2 * angle), 3, 3});
  }
  EXPECT_NE(refusal(eight, true).find("cross itself"), std::string::npos);
}

}  // namespace
}  // namespace slalom::world
