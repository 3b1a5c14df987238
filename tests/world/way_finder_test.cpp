#include "slalom/world/way_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include "slalom/world/footprint.hpp"
#include "slalom/world/way_signature.hpp"
#include "support/allocation_count.hpp"
#include "world/ring.hpp"
#include "world/way_scenes.hpp"

namespace slalom::world {
namespace {

/// E_C as the drive sees it: a row of cones with something standing on the left of it, and
/// something oncoming on the right.
World row_of_cones(double oncoming_speed) {
  World w;
  w.start = state(6, 0, kPi / 2, 17);
  w.environment.goal = {18, 700, kPi / 2, 25};
  w.environment.region.x_min = 0;
  w.environment.region.x_max = 24;
  auto& obstacles = w.environment.obstacles;
  obstacles = {{"O1", 6, 281, 8, 8, 0, 0}, {"O2", 18, 650, 8, 8, 0, -oncoming_speed}};
  for (int k = 0; k < 36; ++k) obstacles.push_back({"cone", 12, 5.0 * k, 2.38735, 2.38735, 0, 0});
  return w;
}

/// A quarter turn of everything to the left; ellipses stay along the axes.
World turned(const World& from) {
  World w = from;
  const auto turn = [](double& x, double& y) { x = std::exchange(y, x) * -1; };
  turn(w.start[vehicle::X], w.start[vehicle::Y]);
  w.start[vehicle::PSI] += kPi / 2;
  turn(w.environment.goal.x, w.environment.goal.y);
  w.environment.goal.psi += kPi / 2;
  const auto& r = from.environment.region;
  w.environment.region = {-r.y_max, -r.y_min, r.x_min, r.x_max};
  for (auto& o : w.environment.obstacles) {
    turn(o.x, o.y);
    turn(o.vx, o.vy);
    std::swap(o.a, o.b);
  }
  return w;
}

/// The way is one that the search's vehicle drives, from the start into the goal, and keeps clear.
void expect_drivable(const World& w, const Way& way, const WaySearch& search = {}) {
  ASSERT_FALSE(way.empty());
  EXPECT_EQ(way.front().t, w.t_start);
  EXPECT_NEAR(way.front().x, w.start[vehicle::X], 1e-4);
  EXPECT_NEAR(way.front().y, w.start[vehicle::Y], 1e-4);
  EXPECT_NEAR(way.front().v, w.start[vehicle::UX], 1e-5);
  const auto& goal = w.environment.goal;
  EXPECT_LT(goal.outside({way.back().x, way.back().y}, way.back().t, nullptr), 0);
  const double dx = way.back().x - goal.x, dy = way.back().y - goal.y;
  EXPECT_LE(std::fabs(dx * std::cos(goal.psi) + dy * std::sin(goal.psi)), 0.5 * goal.sigma + 1e-4);
  EXPECT_LE(std::fabs(dy * std::cos(goal.psi) - dx * std::sin(goal.psi)), 0.6 * goal.sigma + 1e-4);
  EXPECT_GT(clearance(way, w.environment.obstacles), 0.8 * search.clearance);
  for (std::size_t k = 0; k < way.size(); ++k) {
    const auto& q = way[k];
    ASSERT_TRUE(w.environment.region.contains(q.x, q.y)) << q.t;
    ASSERT_GE(q.v, search.v_min);
    ASSERT_LE(q.v, std::max(search.v_max, w.start[vehicle::UX]) + 1e-6);
    const double most = std::min(search.curvature, search.lateral_acceleration / (q.v * q.v));
    ASSERT_LE(std::fabs(q.kappa), 1.05 * most) << q.t;
    if (k == 0) continue;
    const auto& p = way[k - 1];
    const double h = q.t - p.t, v = (p.v + q.v) / 2;
    ASSERT_NEAR(h, 0.05, 1e-9);
    ASSERT_LE(std::fabs(q.kappa - p.kappa) / h, search.curvature_rate + 1e-4);
    ASSERT_GE(q.v - p.v, -search.braking * h - 1e-5);
    ASSERT_LE(q.v - p.v, w.vehicle.ax_max_at(p.v) * h);
    ASSERT_NEAR(q.heading - p.heading, v * (p.kappa + q.kappa) / 2 * h, 1e-4);
    ASSERT_NEAR(std::hypot(q.x - p.x, q.y - p.y), v * h, 2e-3);
    const double mean = (p.heading + q.heading) / 2;
    ASSERT_NEAR((q.x - p.x) * std::sin(mean) - (q.y - p.y) * std::cos(mean), 0, 2e-3);
  }
}

TEST(WayFinder, DrivesStraightOnWhereNothingIs) {
  auto w = northwards();
  w.t_start = 12.3;
  const auto way = w.find();
  ASSERT_TRUE(way);
  expect_drivable(w, *way);
  for (const auto& p : *way) EXPECT_NEAR(p.x, 0, 1e-3);
  EXPECT_LT(way->back().t, 12.3 + 150 / 17.0);
}

TEST(WayFinder, LooksNoLongerAheadThanItIsToldTo) {
  const auto w = northwards();
  EXPECT_FALSE(w.find({.t_max = 3})) << "140 m from 17 m/s on";
  EXPECT_TRUE(w.find({.t_max = 9}));
  auto f = w.finder();
  EXPECT_FALSE(f.find(w.start, 0, {}, {.t_max = 4}));
  EXPECT_EQ(f.looked_at(), 0) << "135 m take longer at 28 m/s";
}

/// Whatever the time it starts at: its moves end .4 s apart.
TEST(WayFinder, ComesInAWindowNarrowerThanAMove) {
  World w = northwards();
  for (const double window : {8.03, 8.13, 8.23, 8.33}) {
    w.environment.goal.t_min = window - 0.05;
    w.environment.goal.t_max = window + 0.05;
    const auto way = w.find();
    ASSERT_TRUE(way) << window;
    EXPECT_NEAR(way->back().t, window, 0.2 + 1e-9);
  }
}

TEST(WayFinder, TurnsAround) {
  auto w = northwards(80);
  w.start = state(0, 0, -kPi / 2, 4);
  const auto way = w.find();
  ASSERT_TRUE(way);
  expect_drivable(w, *way);
}

TEST(WayFinder, FindsTheGapInAWall) {
  auto w = northwards();
  w.environment.region = {-40, 40, -10, 200};
  w.environment.obstacles = {{"left", -14, 80, 28, 2, 0, 0}, {"right", 32, 80, 12, 2, 0, 0}};
  const auto way = w.find();
  ASSERT_TRUE(way);
  expect_drivable(w, *way);
  w.environment.obstacles[1] = {"right", 26.2, 80, 12, 2, 0, 0};
  EXPECT_FALSE(w.find()) << "0.2 m between edges, 1.6 m of clearance";
}

TEST(WayFinder, FindsItsWayOutOfADeadEnd) {
  auto w = northwards(120);
  w.start[vehicle::Y] = -20;
  w.environment.obstacles = {
      {"end", 0, 60, 16, 3, 0, 0}, {"left", -16, 45, 3, 16, 0, 0}, {"right", 16, 45, 3, 16, 0, 0}};
  const auto way = w.find();
  ASSERT_TRUE(way);
  expect_drivable(w, *way);
}

TEST(WayFinder, PassesWhatIsOncoming) {
  for (const double speed : {10.0, 20.0, 30.0}) {
    const auto w = row_of_cones(speed);
    const auto way = w.find();
    ASSERT_TRUE(way) << speed;
    expect_drivable(w, *way);
  }
}

TEST(WayFinder, WaitsForWhatIsOncoming) {
  // The narrows from y = 70 to 180 are free after eight seconds; driving on, the way were there
  // after four.
  auto w = northwards(200);
  w.environment.region = {-12, 12, -10, 230};
  w.environment.obstacles = {{"oncoming", 7, 230, 4.5, 30, 0, -20}};
  for (double y = 78; y < 180; y += 8)
    w.environment.obstacles.push_back({"left", -12, y, 13, 8, 0, 0});
  const WaySearch search{.v_max = 13};
  const auto way = w.find(search);
  ASSERT_TRUE(way);
  expect_drivable(w, *way, search);
  const auto inside =
      std::find_if(way->begin(), way->end(), [](const auto& p) { return p.y > 80; });
  ASSERT_NE(inside, way->end());
  EXPECT_GT(inside->t, 8);
}

TEST(WayFinder, IsTheSameInAllDirections) {
  auto gap = northwards();
  gap.environment.region = {-40, 40, -10, 200};
  gap.environment.obstacles = {{"left", -14, 80, 28, 2, 0, 0}, {"right", 32, 80, 12, 2, 0, 0}};
  for (World w : {gap, row_of_cones(10)}) {
    const auto first = w.find();
    ASSERT_TRUE(first);
    for (int quarter = 1; quarter < 4; ++quarter) {
      w = turned(w);
      const auto way = w.find();
      ASSERT_TRUE(way) << quarter;
      expect_drivable(w, *way);
      EXPECT_NEAR(way->back().t, first->back().t, 0.04 * first->back().t) << quarter;
    }
  }
}

TEST(WayFinder, FindsTheSameAgainToTheBit) {
  const auto w = row_of_cones(20);
  auto f = w.finder();
  const auto first = f.find(w.start, 0, w.environment.obstacles);
  const int looked_at = f.looked_at();
  ASSERT_TRUE(first);
  auto other = northwards();
  f.find(other.start, 3, other.environment.obstacles);
  const auto again = f.find(w.start, 0, w.environment.obstacles);
  EXPECT_EQ(f.looked_at(), looked_at);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->size(), first->size());
  EXPECT_EQ(std::memcmp(again->data(), first->data(), first->size() * sizeof(WayPoint)), 0);
}

TEST(WayFinder, GivesUpWithinItsBudget) {
  const auto w = row_of_cones(20);
  auto f = w.finder();
  int asked = 0;
  const auto over = [&asked] { return ++asked > 3; };
  EXPECT_FALSE(f.find(w.start, 0, w.environment.obstacles, {}, over));
  EXPECT_EQ(f.looked_at(), 3 * 256);
  asked = 0;
  f.find_ways(
      w.start, 0, w.environment.obstacles, {}, 3, [](const Way&) { return true; }, over);
  EXPECT_EQ(f.looked_at(), 2 * 256) << "it is asked before each search too";
  WaySearch search;
  search.max_places = 100;
  EXPECT_FALSE(f.find(w.start, 0, w.environment.obstacles, search));
  EXPECT_EQ(f.looked_at(), 100);
}

TEST(WayFinder, AllocatesNothingButItsAnswer) {
  if (!AllocationCount::available()) GTEST_SKIP() << "sanitizers have their own malloc";
  const auto w = row_of_cones(20);
  auto f = w.finder();
  ASSERT_TRUE(f.find(w.start, 0, w.environment.obstacles));
  AllocationCount allocations;
  const auto way = f.find(w.start, 0, w.environment.obstacles);
  const auto count = allocations.allocations();
  EXPECT_EQ(count, 1u) << allocations.first();
}

TEST(WayFinder, LeavesWhereItMayNotBe) {
  auto w = northwards();
  w.environment.obstacles = {{"beside", 4, 0, 3.5, 3.5, 0, 0}};
  EXPECT_TRUE(w.find()) << "within the clearance";
  w.environment.obstacles[0].x = 3;
  EXPECT_TRUE(w.find()) << "inside";
  w.environment.obstacles[0].x = 0;
  EXPECT_TRUE(w.find()) << "at its centre";
  w.environment.obstacles = {};
  for (const double side : {-0.2, 0.2}) {
    w.environment.region.x_min = side;
    w.environment.goal.x = 5;
    EXPECT_TRUE(w.find()) << "near a side, or past it";
  }
  w = northwards();
  w.start[vehicle::R] = 0.5;
  EXPECT_TRUE(w.find()) << "turning faster than it may";
  w.start = state(0, 0, kPi / 2, 0);
  EXPECT_TRUE(w.find()) << "at rest";
}

/// The ways that find_ways() hands over, all of them taken for good or for bad.
std::vector<Way> ways_of(WayFinder& finder, const World& w, int most, bool good = true) {
  std::vector<Way> ways;
  finder.find_ways(w.start, 0, w.environment.obstacles, {}, most, [&](const Way& way) {
    ways.push_back(way);
    return good;
  });
  return ways;
}

TEST(WayFinder, FindsWaysThatPassDifferently) {
  auto w = northwards();
  w.environment.region = {-20, 20, -20, 180};
  w.environment.obstacles = {{"rock", 0, 80, 5, 5, 0, 0}};
  auto f = w.finder();
  const auto ways = ways_of(f, w, 2);
  ASSERT_EQ(ways.size(), 2u);
  for (const auto& way : ways) expect_drivable(w, way, {.clearance = 0.3});
  EXPECT_TRUE(differ(signature(ways[0], w.environment.obstacles),
                     signature(ways[1], w.environment.obstacles)));
  EXPECT_EQ(ways_of(f, w, 1).size(), 1u);
  EXPECT_TRUE(ways_of(f, w, 0).empty());
  w.environment.region = {-20, 4, -20, 180};
  WayFinder narrow(w.environment, w.vehicle);
  EXPECT_EQ(ways_of(narrow, w, 2).size(), 1u) << "one side alone is open";
  const auto slower = ways_of(narrow, w, 2, false);
  ASSERT_EQ(slower.size(), 2u) << "a way that is no good does not stand for those like it";
  EXPECT_GT(slower[1].back().t, slower[0].back().t);
}

TEST(WayFinder, TheSearchFollowsFromTheVehicle) {
  const WaySearch as_found;
  const auto hmmwv = way_search({});
  EXPECT_EQ(hmmwv.v_max, as_found.v_max);
  EXPECT_EQ(hmmwv.braking, as_found.braking);
  EXPECT_EQ(hmmwv.lateral_acceleration, as_found.lateral_acceleration);
  EXPECT_EQ(hmmwv.curvature, as_found.curvature);
  EXPECT_EQ(hmmwv.curvature_rate, as_found.curvature_rate);

  vehicle::Parameters car;
  car.ux_max = 50;
  car.ax_min[3] *= 2;
  car.sr_max_deg *= 4;
  car.KZYR /= 1.2;
  const auto nimble = way_search(car);
  EXPECT_EQ(nimble.v_max, 49);
  EXPECT_NEAR(nimble.braking, 2 * as_found.braking, 1e-12);
  EXPECT_NEAR(nimble.curvature_rate, 4 * as_found.curvature_rate, 1e-12);
  EXPECT_NEAR(nimble.lateral_acceleration, 1.2 * as_found.lateral_acceleration, 1e-12);
}

TEST(WayFinder, KeepsTheBodyOnTheRoadThroughABendThatGoesBack) {
  Environment environment;
  environment.road = test::hairpin();
  environment.goal.s = environment.road->length() - 10;
  environment.goal = placed(environment.goal, environment.road.get());
  vehicle::Parameters car;
  car.footprint = vehicle::FootprintKind::rectangle;
  WayFinder finder(environment, car);
  WaySearch search;
  const auto way = finder.find({5, 0, 0, 0, 0, 0, 10, 0}, 0, {}, search);
  ASSERT_TRUE(way);
  // The body's axis is off the way's direction by the front wheels' steering.
  for (const WayPoint& p : *way) {
    const vehicle::State state{p.x, p.y, 0, 0, p.heading - (car.la + car.lb) * p.kappa, 0, p.v, 0};
    EXPECT_GT(Footprint(car).edge_distance(*environment.road, state), 0) << p.t;
  }
  EXPECT_GE(environment.road->project({way->back().x, way->back().y}).s, environment.goal.s);
}

}  // namespace
}  // namespace slalom::world
