// Ways along a road: their paths, and their speeds in time.

#include "slalom/world/road_ways.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "../../src/world/road_path.hpp"
#include "box.hpp"
#include "ring.hpp"
#include "slalom/vehicle/agility.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::world {
namespace {

using namespace vehicle;

Parameters car() {
  Parameters p;
  p.footprint = FootprintKind::rectangle;
  p.length = 4.5;
  p.width = 1.6;
  p.front_overhang = 1;
  p.la = 1.2;
  p.lb = 1.4;
  p.sa_max_deg = 50;
  p.sr_max_deg = 25;
  p.jx_max = 20;
  p.ax_max = {0, 0, 0, 4};
  p.ax_min = {0, 0, 0, -8};
  return p;
}

std::shared_ptr<const Road> road_of(std::vector<RoadPoint> points) {
  return std::make_shared<Road>(std::move(points), false, std::vector<std::vector<Point>>{},
                                "road");
}

/// Eastwards for 200 m.
std::shared_ptr<const Road> straight(double right, double left) {
  return road_of({{-20, 0, right, left}, {90, 0, right, left}, {200, 0, right, left}});
}

/// Eastwards, then to the left round a quarter of a circle of radius 7 m.
std::shared_ptr<const Road> corner(double half) {
  std::vector<RoadPoint> line;
  for (double x = -20; x <= 20; x += 2) line.push_back({x, 0, half, half});
  for (double angle = 0.2; angle < std::numbers::pi / 2; angle += 0.2)
    line.push_back({20 + 7 * std::sin(angle), 7 - 7 * std::cos(angle), half, half});
  for (double y = 8; y <= 60; y += 2) line.push_back({27, y, half, half});
  return road_of(line);
}

struct Ways : ::testing::Test {
  Parameters vehicle = car();
  Environment environment;
  State start = {0, 0, 0, 0, 0, 0, 10, 0};
  RoadWaySearch search;

  Ways() {
    environment.road = straight(2, 5);
    to_line(100);
  }
  void to_line(double s) {
    environment.goal = {};
    environment.goal.s = s;
    environment.goal = placed(environment.goal, environment.road.get());
  }
  /// 2 m wide on the road's line, within a tenth of a second.
  void to_rectangle(double x, double length, double t_min) {
    environment.goal = {x, 0, 0};
    environment.goal.length = length;
    environment.goal.width = 2;
    environment.goal.t_min = t_min;
    environment.goal.t_max = t_min + 0.1;
  }
  std::vector<RoadWay> to_goal(const std::vector<Obstacle>& obstacles = {}) {
    return RoadWays(environment, vehicle).to_goal(start, 0, obstacles, search);
  }
  std::vector<RoadWay> to_stand(const std::vector<Obstacle>& obstacles = {}) {
    return RoadWays(environment, vehicle).to_stand(start, 0, obstacles, search);
  }
  State state_of(const WayPoint& at) const {
    State x{};
    x[X] = at.x;
    x[Y] = at.y;
    x[PSI] = at.heading - std::asin(at.kappa * (vehicle.la + vehicle.lb));
    x[UX] = at.v;
    return x;
  }
  /// Least distances of the way's body from the road's edge and from an obstacle.
  double edge(const Way& way) const {
    double least = HUGE_VAL;
    for (const auto& at : way)
      least = std::min(least, Footprint(vehicle).edge_distance(*environment.road, state_of(at)));
    return least;
  }
  double distance(const Way& way, const Obstacle& o) const {
    double least = HUGE_VAL;
    for (const auto& at : way)
      least = std::min(least, Footprint(vehicle).distance(o, state_of(at), at.t));
    return least;
  }
};

TEST_F(Ways, TheBestIsTheSoonest) {
  const auto ways = to_goal();
  ASSERT_FALSE(ways.empty());
  EXPECT_TRUE(ways[0].complete);
  EXPECT_NEAR(ways[0].way[0].v, 10, 1e-9);
  // 80 m to the line from 10 m/s at 3.6 m/s^2 are 4.5 s.
  EXPECT_NEAR(ways[0].end, 4.6, 0.4);
  EXPECT_NEAR(ways[0].way.back().t, ways[0].end + search.beyond, 0.11) << "and then it brakes";
  EXPECT_LT(ways[0].way.back().v, ways[0].way[ways[0].way.size() - 15].v - 2);
  for (const auto& way : ways) EXPECT_GE(edge(way.way), search.edge - 0.03);
}

TEST_F(Ways, PassesWhatStandsWhereThereIsRoom) {
  const Obstacle parked = test::box(40, -0.5, 5, 2, 0);
  const auto ways = to_goal({parked});
  ASSERT_FALSE(ways.empty());
  EXPECT_GE(distance(ways[0].way, parked), search.clearance - 0.03);
  environment.road = straight(2, 2.2);
  EXPECT_TRUE(to_goal({parked}).empty());
  const auto stops = to_stand({parked});
  ASSERT_FALSE(stops.empty());
  EXPECT_TRUE(stops[0].complete);
  EXPECT_GT(distance(stops[0].way, parked), search.clearance - 0.03);
}

// One is to be passed on each side: only a path that swings between them keeps off both.
TEST_F(Ways, KeepsAsFarFromBoxesAsItIsTo) {
  environment.road = straight(2, 4.2);
  to_line(120);
  for (const double margin : {0., 0.4}) {
    Obstacle first = test::box(40, -0.6, 5, 2, 0), second = test::box(75, 2.4, 5, 2, 0);
    first.margin_start = second.margin_start = margin;
    search.clearance = 0.5 - margin;
    const auto ways = to_goal({first, second});
    ASSERT_FALSE(ways.empty()) << margin;
    EXPECT_GE(std::min(distance(ways[0].way, first), distance(ways[0].way, second)), 0.47);
    EXPECT_GE(edge(ways[0].way), search.edge - 0.03);
  }
}

TEST_F(Ways, FitsThroughWhereTheBodyAndWhatItKeepsFit) {
  environment.road = straight(2, 2);
  to_line(150);
  // 2.4 m between them and the edge: the body, what it keeps on both sides, and 20 cm.
  search.clearance = 0.5;
  const Obstacle first = test::box(40, -1.3, 5, 1.8, 0), second = test::box(80, 1.3, 5, 1.8, 0);
  const Obstacle round{"round", 115, -1.3, 0.9, 0.9};
  const auto ways = to_goal({first, second, round});
  ASSERT_FALSE(ways.empty());
  for (const Obstacle& o : {first, second, round}) EXPECT_GE(distance(ways[0].way, o), 0.47);
}

TEST_F(Ways, OnAClosedRoadSeesWhatStandsBeyondTheSeam) {
  environment.road = test::ring(60, 3.1);
  const double lap = environment.road->length();
  const auto at = [&](double s, double n) {
    const RoadPlace place = environment.road->at(s);
    const Point p = place.point() + place.aside() * n;
    return test::box(p.x, p.y, 5, 2, place.psi);
  };
  to_line(85);
  search.clearance = 0.5;
  const RoadPlace begin = environment.road->at(lap - 40);
  start = {begin.x, begin.y, 0, 0, begin.psi, 0, 10, 0};
  // On the seam, and beyond it on the other side.
  const Obstacle first = at(0, -1.7), second = at(37, 1.7);
  const auto ways = to_goal({first, second});
  ASSERT_FALSE(ways.empty());
  EXPECT_GE(std::min(distance(ways[0].way, first), distance(ways[0].way, second)), 0.47);
}

TEST_F(Ways, OnAClosedRoadHasArrivedBeyondALine) {
  environment.road = test::ring(60, 3.1);
  to_line(30);
  environment.goal.ux_max = 6;
  const RoadPlace begin = environment.road->at(32);
  start = {begin.x, begin.y, 0, 0, begin.psi, 0, 10, 0};
  const auto ways = to_goal();
  ASSERT_FALSE(ways.empty());
  EXPECT_LT(ways[0].end, 3) << "no lap more";
}

TEST_F(Ways, WaitsForWhatCrosses) {
  environment.road = straight(2, 2);
  const double soonest = to_goal()[0].end;
  // A wall that is away from 6 s on.
  Obstacle gate = test::box(50, 0, 1, 8, 0);
  gate.trajectory =
      std::make_shared<TableTrajectory>(std::vector<TrajectoryRow>{{0, 50, 0, 0}, {6, 50, 0, 0}},
                                        BeyondEnd::stands, BeyondEnd::absent, "gate");
  const auto ways = to_goal({gate});
  ASSERT_FALSE(ways.empty());
  EXPECT_GT(ways[0].end, soonest + 1);
  for (const auto& at : ways[0].way)
    if (at.t < 6) EXPECT_LT(at.x + vehicle.front_overhang, 49.5) << at.t;
}

TEST_F(Ways, ComesInItsWindowOfTime) {
  to_rectangle(60, 10, 9);
  const auto ways = to_goal();
  ASSERT_FALSE(ways.empty());
  EXPECT_NEAR(ways[0].end, 9.05, 0.06);
  environment.goal.t_min = 0;
  environment.goal.t_max = 2;
  EXPECT_TRUE(to_goal().empty()) << "55 m in 2 s";
}

// Whatever of its last move a time leaves.
TEST_F(Ways, ComesAsFarAsItCanByEachTime) {
  vehicle.ux_max = 12;
  environment.goal = {};
  environment.goal.time = 20;
  environment.goal = placed(environment.goal, environment.road.get());
  RoadWays ways(environment, vehicle);
  for (const double begin : {0.05, 0.3, 0.7, 1., 1.2}) {
    const auto found = ways.to_goal(start, begin, {}, search);
    ASSERT_FALSE(found.empty()) << begin;
    EXPECT_NEAR(found[0].end, 20, 0.101) << begin;
    const auto there = std::find_if(found[0].way.begin(), found[0].way.end(),
                                    [](const WayPoint& p) { return p.t >= 20; });
    EXPECT_GT(there->x, 10.5 * (20 - begin)) << begin;
  }
}

TEST_F(Ways, AGoalMayBeFarAndNoFartherThanPathsAre) {
  const auto by_time = [&](double time) {
    environment.goal = {};
    environment.goal.time = time;
    environment.goal = placed(environment.goal, environment.road.get());
  };
  by_time(30);
  const auto ways = to_goal();
  ASSERT_FALSE(ways.empty());
  EXPECT_NEAR(ways[0].end, 30, 0.101);
  EXPECT_GT(ways[0].way.back().x, 700);
  by_time(60);
  EXPECT_TRUE(to_goal().empty());
  environment.road = road_of({{-20, 0, 2, 5}, {1500, 0, 2, 5}});
  to_line(650);
  EXPECT_FALSE(to_goal().empty());
  to_line(1200);
  EXPECT_TRUE(to_goal().empty());
}

// What stands there ends the path: the best by a time is to come before it.
TEST_F(Ways, ByATimeItComesAsFarAsWhatStands) {
  environment.road = straight(2, 2);
  environment.goal = {};
  environment.goal.time = 9;
  environment.goal = placed(environment.goal, environment.road.get());
  const Obstacle parked = test::box(60, 0, 5, 3, 0);
  const auto ways = to_goal({parked});
  ASSERT_FALSE(ways.empty());
  EXPECT_NEAR(ways[0].end, 9, 0.101);
  EXPECT_GT(ways[0].way.back().x, 45);
}

TEST_F(Ways, AVehicleAtRestBesideTheEdgeDrivesOff) {
  search.edge = 0.2;
  for (const double psi : {0., -0.02, 0.01}) {
    start = {0, -1.13, 0, 0, psi, 0, 0, 0};
    const double begin = Footprint(vehicle).edge_distance(*environment.road, start);
    ASSERT_LT(begin, 0.1);
    const auto ways = to_goal();
    ASSERT_FALSE(ways.empty()) << psi;
    EXPECT_GE(edge(ways[0].way), begin - 0.04);
    for (const auto& at : ways[0].way)
      if (at.x > 8.5)
        EXPECT_GE(Footprint(vehicle).edge_distance(*environment.road, state_of(at)), 0.19) << at.x;
    EXPECT_FALSE(to_stand().empty());
  }
}

// It begins in a long goal whose time comes late: it has to be slow enough not to leave it before.
TEST_F(Ways, StaysInALongGoalUntilItsTime) {
  to_rectangle(30, 80, 16);
  Obstacle ahead = test::box(14, 0, 5, 1.8, 0), behind = test::box(-12, 0, 5, 1.8, 0);
  ahead.vx = behind.vx = 3;
  const auto ways = to_goal({ahead, behind});
  ASSERT_FALSE(ways.empty());
  EXPECT_NEAR(ways[0].end, 16.05, 0.06);
  for (const auto& at : ways[0].way)
    if (at.t <= ways[0].end) EXPECT_LT(at.x, 70);
  EXPECT_GE(std::min(distance(ways[0].way, ahead), distance(ways[0].way, behind)),
            search.clearance - 0.05);
}

TEST_F(Ways, ChangesItsAccelerationNoFasterThanTheVehicle) {
  const Obstacle parked = test::box(40, 0, 5, 4, 0);
  environment.road = straight(2, 2);
  start[UX] = 15;
  const auto stops = to_stand({parked});
  ASSERT_FALSE(stops.empty());
  const Way& way = stops[0].way;
  double hardest = 0;
  for (std::size_t k = 1; k < way.size() && way[k].v > 1; ++k) {
    const double dt = way[k].t - way[k - 1].t;
    const double a = (way[k].v - way[k - 1].v) / dt;
    // By the jerk from rest on, with the half step over which speeds are differenced.
    EXPECT_GE(a, -vehicle.jx_max * (way[k].t + 0.05)) << way[k].t;
    hardest = std::min(hardest, a);
  }
  EXPECT_LT(hardest, -4);
}

// In the middle of the lane the rear wheels would cut the corner.
TEST_F(Ways, SwingsOutInATightBend) {
  environment.road = corner(1.5);
  to_line(50);
  start[UX] = 5;
  const OnRoad on = environment.road->project({0, 0});
  const RoadPath path(*environment.road, vehicle, start, on, {0, 12, 0.1, 50, {}});
  double least = HUGE_VAL, turned = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    State x{};
    x[X] = path[k].x;
    x[Y] = path[k].y;
    x[PSI] = path[k].psi;
    least = std::min(least, Footprint(vehicle).edge_distance(*environment.road, x));
    turned = std::max(turned, path[k].heading);
  }
  EXPECT_GT(least, 0);
  EXPECT_NEAR(turned, std::numbers::pi / 2, 0.1);
  const auto ways = to_goal();
  ASSERT_FALSE(ways.empty());
  double fastest = 0;
  for (const auto& at : ways[0].way) fastest = std::max(fastest, at.v * at.v * std::fabs(at.kappa));
  EXPECT_LT(fastest, 1.1 * search.limits * most_lateral(vehicle));
}

TEST_F(Ways, WhereNoStopIsGoodItGoesWellAsLongAsItCan) {
  environment.road = straight(2, 2);
  const Obstacle chaser = [] {
    Obstacle o = test::box(-12, 0, 4, 3, 0);
    o.vx = 14;
    return o;
  }();
  const auto stops = to_stand({chaser});
  ASSERT_FALSE(stops.empty());
  EXPECT_FALSE(stops[0].complete);
  EXPECT_GT(stops[0].end, 2);
  EXPECT_GT(stops[0].way.back().x, 15) << "it flees";
}

TEST_F(Ways, TheSameQuestionsHaveTheSameAnswers) {
  const Obstacle parked = test::box(40, -0.5, 5, 2, 0);
  const auto once = to_goal({parked}), again = to_goal({parked});
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t k = 0; k < once.size(); ++k) {
    EXPECT_EQ(once[k].end, again[k].end);
    EXPECT_EQ(once[k].way.back().x, again[k].way.back().x);
  }
}

TEST_F(Ways, GivesUpWhenItsBudgetIsOver) {
  RoadWays ways(environment, vehicle);
  EXPECT_TRUE(ways.to_goal(start, 0, {}, search, [] { return true; }).empty());
}

}  // namespace
}  // namespace slalom::world
