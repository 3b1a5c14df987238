// Ways among shapes, tables and for a vehicle with a body.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "slalom/world/footprint.hpp"
#include "slalom/world/way_finder.hpp"
#include "slalom/world/way_signature.hpp"
#include "world/box.hpp"
#include "world/ring.hpp"

namespace slalom::world {
namespace {

using test::box;

/// Northwards at 10 m/s with a body, in a street 16 m wide.
struct Street : ::testing::Test {
  Environment environment;
  vehicle::Parameters vehicle;
  vehicle::State start{0, 0, 0, 0, std::numbers::pi / 2, 0, 10, 0};

  Street() {
    vehicle.footprint = vehicle::FootprintKind::rectangle;
    environment.goal = {0, 120, std::numbers::pi / 2, 8};
    environment.region.x_min = -8;
    environment.region.x_max = 8;
  }
  std::optional<Way> find() const {
    std::optional<Way> found;
    WayFinder(environment, vehicle)
        .find_ways(start, 0, environment.obstacles, {}, 1, [&](const Way& way) {
          found = way;
          return true;
        });
    return found;
  }
  /// Of the body as it follows the way without slip, by the exact shapes.
  double clearance(const Way& way) const {
    const Footprint footprint(vehicle);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& p : way) {
      vehicle::State x{};
      x[vehicle::X] = p.x;
      x[vehicle::Y] = p.y;
      x[vehicle::PSI] = p.heading - std::asin((vehicle.la + vehicle.lb) * p.kappa);
      for (const auto& o : environment.obstacles)
        if (o.present(p.t, p.t)) least = std::min(least, footprint.distance(o, x, p.t));
    }
    return least;
  }
};

TEST_F(Street, ABodyFindsItsWayPastBoxes) {
  environment.obstacles = {box(-3, 40, 9, 2, 0.3), box(4, 75, 8, 2, -0.2)};
  const auto way = find();
  ASSERT_TRUE(way);
  EXPECT_GT(clearance(*way), 0.8 - 0.1) << "a tenth of a move apart it may be nearer";
  EXPECT_LT(clearance(*way), 2.5);
}

TEST_F(Street, ACarThatTurnsIsWhereItsTableSays) {
  auto car = box(0, 0, 12, 2, 0);
  // Comes along the left side, and stands across the way for a while when the vehicle would come.
  car.trajectory = std::make_shared<TableTrajectory>(std::vector<TrajectoryRow>{{0, -6, 80, -1.57},
                                                                                {3, -6, 60, -1.57},
                                                                                {5.3, 0, 52, 0},
                                                                                {8.3, 0, 52, 0},
                                                                                {10.3, 10, 52, 0},
                                                                                {12.3, 30, 52, 0}},
                                                     BeyondEnd::stands, BeyondEnd::absent, "car");
  environment.obstacles = {car};
  const auto way = find();
  ASSERT_TRUE(way);
  EXPECT_GT(clearance(*way), 0.6) << "a table is taken to go straight within a move";
  // As if it went straight on for good, the way is another.
  environment.obstacles[0].trajectory = nullptr;
  environment.obstacles[0].x = -6;
  environment.obstacles[0].y = 80;
  environment.obstacles[0].psi = -1.57;
  environment.obstacles[0].vy = -20 / 3.;
  const auto other = find();
  ASSERT_TRUE(other);
  environment.obstacles = {car};
  EXPECT_LT(clearance(*other), 0.6) << "or the table is not in the way";
}

TEST_F(Street, WhatIsAbsentIsNotPassed) {
  auto wall = box(0, 0, 30, 2, 0);
  const std::vector<TrajectoryRow> rows = {{0, 0, 50, 0}, {2, 0, 50, 0}};
  wall.trajectory =
      std::make_shared<TableTrajectory>(rows, BeyondEnd::stands, BeyondEnd::absent, "wall");
  environment.obstacles = {wall};
  const auto way = find();
  ASSERT_TRUE(way);
  EXPECT_LT(way->back().t, 12) << "straight through";
  EXPECT_GT(signature(*way, environment.obstacles)[0].nearest, 20) << "while it is there";
  wall.trajectory =
      std::make_shared<TableTrajectory>(rows, BeyondEnd::stands, BeyondEnd::stands, "wall");
  environment.obstacles = {wall};
  EXPECT_FALSE(WayFinder(environment, vehicle)
                   .find(start, 0, environment.obstacles, {.t_max = 20, .max_places = 20000}));
}

/// On a closed road round a circle.
struct Ring : Street {
  const double lap;

  Ring() : lap(test::ring(60, 3.5)->length()) {
    environment = {};
    environment.road = test::ring(60, 3.5);
  }
  void begin_at(double s) {
    const RoadPlace at = environment.road->at(s);
    start = {at.x, at.y, 0, 0, at.psi, 0, 10, 0};
  }
  void to_line(double s) {
    environment.goal = {};
    environment.goal.s = s;
    environment.goal = placed(environment.goal, environment.road.get());
  }
  void to_place(double s) {
    const RoadPlace at = environment.road->at(s);
    environment.goal = {at.x, at.y, at.psi, 4};
  }
  std::optional<Way> find_soon() const {
    return WayFinder(environment, vehicle).find(start, 0, {}, {.max_places = 20000});
  }
  double seconds() const {
    const auto way = find_soon();
    return way ? way->back().t : HUGE_VAL;
  }
};

TEST_F(Ring, GoalsBeyondTheSeamAreAhead) {
  begin_at(lap - 60);
  to_line(lap);
  EXPECT_LT(seconds(), 8);
  to_line(40);
  EXPECT_LT(seconds(), 12);
  to_place(40);
  EXPECT_LT(seconds(), 12);
  begin_at(100);
  to_line(160);
  EXPECT_LT(seconds(), 8);
}

TEST_F(Ring, APlaceThatLiesBehindIsALapAhead) {
  begin_at(100);
  to_place(60);
  EXPECT_LT(seconds(), 45);
  EXPECT_GT(seconds(), 15);
}

TEST_F(Ring, BeyondALineItHasArrived) {
  begin_at(43);
  to_line(40);
  environment.goal.ux_max = 8;
  EXPECT_LT(seconds(), 5);
}

TEST_F(Ring, ByATimeItComesAsFarAcrossTheSeamAsElsewhere) {
  environment.goal = {};
  environment.goal.time = 8;
  environment.goal = placed(environment.goal, environment.road.get());
  const auto driven = [&](double s) {
    begin_at(s);
    const auto way = find_soon();
    if (!way) return -1.;
    return environment.road->project({way->back().x, way->back().y}).s - s;
  };
  const double elsewhere = driven(100);
  EXPECT_GT(elsewhere, 80);
  EXPECT_NEAR(driven(lap - 60) + lap, elsewhere, 5);
}

TEST_F(Street, ARoadKeepsItWhereItBeginsBeforeIt) {
  environment = {};
  environment.road = test::hairpin();
  environment.goal.s = environment.road->length();
  environment.goal = placed(environment.goal, environment.road.get());
  for (const double x : {-15., -50.}) {
    start = {x, 0, 0, 0, 0, 0, 10, 0};
    const auto way = WayFinder(environment, vehicle).find(start, 0, {}, {.max_places = 50000});
    ASSERT_TRUE(way) << x;
    const Footprint footprint(vehicle);
    for (const WayPoint& p : *way) {
      const double axis = p.heading - (vehicle.la + vehicle.lb) * p.kappa;
      EXPECT_GT(footprint.edge_distance(*environment.road, {p.x, p.y, 0, 0, axis, 0, p.v, 0}), 0)
          << p.t;
    }
  }
}

}  // namespace
}  // namespace slalom::world
