// Exact distances of bodies of any shape, and the discs that cover them.

#include "slalom/world/footprint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

namespace slalom::world {
namespace {

using vehicle::State;

Obstacle ellipse(double a, double b, double psi) {
  Obstacle o{"ellipse", 1, 2, a, b};
  o.psi = psi;
  return o;
}

Obstacle outlined(Polygon polygon, double psi, double rounding = 0) {
  Obstacle o{"polygon", 1, 2};
  o.a = o.b = polygon.reach();
  o.outline = std::make_shared<Polygon>(std::move(polygon));
  o.psi = psi;
  o.rounding = rounding;
  return o;
}

const Polygon kTriangle({{-1, -1}, {2.5, 0}, {0, 1.5}}, "test");

std::vector<Obstacle> shapes() {
  return {{"circle", 1, 2, 1.5, 1.5},
          {"along the axes", 1, 2, 3, 1},
          ellipse(3, 1, 0.7),
          outlined(Polygon::rectangle(4.5, 1.8), 0.4),
          outlined(Polygon::rectangle(1, 6, {0.5, 0}), -2),
          outlined(kTriangle, 2),
          outlined(kTriangle, 2, 0.5)};
}

std::vector<State> states() {
  std::mt19937 draw(5);
  std::uniform_real_distribution<double> place(-7, 7), angle(-4, 4);
  std::vector<State> result;
  for (int i = 0; i < 40; ++i) {
    State state{};
    state[vehicle::X] = 1 + place(draw);
    state[vehicle::Y] = 2 + place(draw);
    state[vehicle::PSI] = angle(draw);
    result.push_back(state);
  }
  return result;
}

Footprint body() {
  vehicle::Parameters car;
  car.footprint = vehicle::FootprintKind::rectangle;
  return Footprint(car);
}

TEST(Footprint, ARectangleLiesAheadOfTheFrontAxleByTheOverhang) {
  const vehicle::Parameters car;
  State state{};
  state[vehicle::X] = 10;
  state[vehicle::Y] = 20;
  state[vehicle::PSI] = std::numbers::pi / 2;
  double north = -1e9, south = 1e9, west = 1e9, east = -1e9;
  for (const Point& p : body().at(state)) {
    north = std::max(north, p.y);
    south = std::min(south, p.y);
    west = std::min(west, p.x);
    east = std::max(east, p.x);
  }
  EXPECT_NEAR(north, 20 + car.front_overhang, 1e-12);
  EXPECT_NEAR(north - south, car.length, 1e-12);
  EXPECT_NEAR(west, 9, 1e-12);
  EXPECT_NEAR(east, 11, 1e-12);
  EXPECT_DOUBLE_EQ(body().reach(), std::hypot(car.length - car.front_overhang, 1));
  EXPECT_TRUE(Footprint(car).is_point());
  EXPECT_EQ(Footprint(car).reach(), 0);
}

TEST(Footprint, IsOutsideARegionByItsFarthestCorner) {
  const vehicle::Parameters car;
  State state{};
  state[vehicle::X] = 10;
  Region region;
  EXPECT_LT(body().outside(region, state), 0);
  region.x_max = 10 + car.front_overhang + 0.1;
  EXPECT_NEAR(body().outside(region, state), -0.1, 1e-12);
  region.y_min = -car.width / 2 + 0.2;
  EXPECT_NEAR(body().outside(region, state), 0.2, 1e-12);
  EXPECT_NEAR(Footprint(car).outside(region, state),
              std::max(region.y_min, -car.front_overhang - 0.1), 1e-12);
  EXPECT_TRUE(region.contains(10, 0));
  state[vehicle::PSI] = std::numbers::pi / 2;
  EXPECT_NEAR(body().outside(region, state), car.length - car.front_overhang + region.y_min, 1e-9);
}

// Of a point: the exact distance to points of the edge.
TEST(Footprint, DistancesAreThoseOfADenseSearch) {
  const auto car = body();
  const double step = 0.02;
  for (const auto& o : shapes())
    for (const auto& state : states()) {
      const double d = car.distance(o, state, 0);
      double least = std::numeric_limits<double>::infinity();
      const auto corners = car.at(state);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Point along = corners[(k + 1) % corners.size()] - corners[k];
        for (double s = 0; s < along.norm(); s += step) {
          const Point p = corners[k] + along * (s / along.norm());
          least = std::min(least, distance(o, p.x, p.y, 0));
        }
      }
      // The footprint may lie about the whole obstacle.
      if (signed_distance({o.x_at(0), o.y_at(0)}, corners) < 0) least = std::min(least, -1e-9);
      EXPECT_EQ(d < 0, least < 0) << o.name << " " << d << " " << least;
      if (d > 0) EXPECT_NEAR(d, least, step) << o.name;
      if (d > 0) EXPECT_LE(d, least + 1e-9) << o.name;
    }
}

TEST(Footprint, ACirclesDepthIsExactAlsoWhereItsCentreIsUnderTheBody) {
  const auto car = body();
  Obstacle circle{"post", 0, 0, 0.25, 0.25};
  State state{};  // heading east: the body reaches 0.649 m ahead and 1 m to both sides
  EXPECT_DOUBLE_EQ(car.distance(circle, state, 0), -0.649 - 0.25);
  circle.x = 1.649;
  EXPECT_NEAR(car.distance(circle, state, 0), 0.75, 1e-12);
}

TEST(Footprint, ADistanceIsThatOfThePlaceAtItsTime) {
  auto box = outlined(Polygon::rectangle(4, 2), 0);
  box.vx = 3;
  box.vy = -1;
  EXPECT_DOUBLE_EQ(distance(box, 13, -1, 2), 13 - (1 + 6) - 2);
  box.trajectory = std::make_shared<TurningTrajectory>(0, Pose{0, 0, 0, 0, 0, 0.5});
  const double quarter = std::numbers::pi;
  EXPECT_NEAR(distance(box, 0, 5, 0), 4, 1e-12);
  EXPECT_NEAR(distance(box, 0, 5, quarter), 3, 1e-12);
  EXPECT_NEAR(box.fastest(0, 1), 0.5 * std::sqrt(5), 1e-12);
}

/// Points of a body's edge: where rays from its middle leave it.
std::vector<Point> edge_of(const Obstacle& o, double t) {
  const Pose pose = o.pose_at(t);
  Point middle = o.outline ? Point{} : Point{pose.x, pose.y};
  for (const Point& p : o.corners_at(t))
    middle = middle + p * (1. / double(o.outline->corners().size()));
  std::vector<Point> edge;
  for (int k = 0; k < 360; ++k) {
    const double angle = k * std::numbers::pi / 180;
    const Point ray{std::cos(angle), std::sin(angle)};
    double in = 0, out = 20;
    while (out - in > 1e-9) {
      const double half = (in + out) / 2;
      const Point p = middle + ray * half;
      (distance(o, p.x, p.y, t) < 0 ? in : out) = half;
    }
    edge.push_back(middle + ray * in);
  }
  return edge;
}

TEST(CoveringDiscs, CoverAnObstacleWhereverItGoes) {
  auto list = shapes();
  for (auto& o : shapes()) {
    o.x = o.y = o.psi = 0;
    o.trajectory = std::make_shared<TurningTrajectory>(1, Pose{3, 4, 0.5, 2, -1, 0.3});
    list.push_back(o);
  }
  for (const auto& o : list)
    for (const double excess : {0.05, 0.3, 2.})
      for (const double t : {0., 3.}) {
        const auto discs = covering_discs(o, excess);
        EXPECT_LE(discs.size(), std::size_t{kMostDiscs});
        for (const Point& p : edge_of(o, t)) {
          double least = std::numeric_limits<double>::infinity();
          for (const auto& disc : discs) least = std::min(least, distance(disc, p.x, p.y, t));
          EXPECT_LE(least, 1e-7) << o.name << " " << excess;
        }
      }
}

TEST(CoveringDiscs, OfTheVehicleCoverItsFootprint) {
  const auto car = body();
  for (const double excess : {0.05, 0.2, 0.5}) {
    const auto discs = car.covering_discs(excess);
    const auto& corners = car.corners();
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (double share = 0; share < 1; share += 0.01) {
        const Point p = corners[k] + (corners[(k + 1) % corners.size()] - corners[k]) * share;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& disc : discs)
          least = std::min(least, std::hypot(p.x - disc.ahead, p.y) - disc.radius);
        EXPECT_LE(least, 1e-9);
      }
    for (const auto& disc : discs) EXPECT_LE(disc.radius, 1 + excess + 1e-9);
  }
  const auto point = Footprint({}).covering_discs(0.1);
  ASSERT_EQ(point.size(), 1U);
  EXPECT_EQ(point[0].ahead, 0);
  EXPECT_EQ(point[0].radius, 0);
}

TEST(CoveringDiscs, APlainObstacleIsItself) {
  const Obstacle plain{"E", 1, 2, 3, 1, 0.5, 0};
  const auto discs = covering_discs(plain, 0.1);
  ASSERT_EQ(discs.size(), 1U);
  EXPECT_EQ(discs[0].a, 3);
  EXPECT_EQ(discs[0].vx, 0.5);
}

}  // namespace
}  // namespace slalom::world
