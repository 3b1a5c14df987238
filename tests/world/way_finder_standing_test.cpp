#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "slalom/world/trajectory.hpp"
#include "world/way_scenes.hpp"

namespace slalom::world {
namespace {

TEST(WayFinder, TurnsAsideAsItDrivesOff) {
  // A vehicle that all but stands, 15 m before a wall that ends 2 m to the right of it.
  auto w = northwards();
  w.start = state(0, 0, kPi / 2, 0.12);
  w.environment.region = {-6, 12, -10, 170};
  w.environment.obstacles = {{"wall", -6, 18, 7.2, 1.2, 0, 0}};
  for (const auto footprint : {vehicle::FootprintKind::point, vehicle::FootprintKind::rectangle}) {
    w.vehicle.footprint = footprint;
    const auto way = w.find();
    ASSERT_TRUE(way) << static_cast<int>(footprint);
    EXPECT_GT(clearance(*way, w.environment.obstacles), 0.6);
  }
}

TEST(WayFinder, FrontWheelsThatPointAsideLeadThere) {
  auto w = northwards(40);
  w.start = state(0, 0, kPi / 2, 0.12);
  w.start[vehicle::SA] = 0.2;
  const auto way = w.find();
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->front().heading, kPi / 2 + 0.2, 1e-6);
  EXPECT_NEAR(way->front().kappa, std::sin(0.2) / (w.vehicle.la + w.vehicle.lb), 1e-6);
}

/// What comes slowly along the lane leaves room to stand on its right alone; `by_trajectory` or
/// not.
World lane_that_fills(bool by_trajectory) {
  auto w = northwards(200);
  w.environment.region = {-6, 9, -10, 230};
  Obstacle o{"oncoming", -1, 75, 3, 8, 0, -1.5};
  if (by_trajectory) {
    o.trajectory = std::make_shared<TableTrajectory>(
        std::vector<TrajectoryRow>{{0, o.x, o.y, 0}, {100, o.x, o.y - 150, 0}}, BeyondEnd::stands,
        BeyondEnd::stands, "oncoming");
    o.vy = 0;
  }
  w.environment.obstacles = {o};
  return w;
}

TEST(WayFinder, EndsWhereTheVehicleCanStand) {
  const Standstill standstill{.stopping = 1, .creep = 0.12, .horizon = 60, .onwards = 0.85};
  const WaySearch search{.clearance = 0.4, .t_max = 80, .cell_speed = 1.2, .cell_time = 0.4};
  for (const bool by_trajectory : {false, true}) {
    const auto w = lane_that_fills(by_trajectory);
    auto finder = w.finder();
    const auto way =
        finder.to_stand(w.start, w.t_start, w.environment.obstacles, search, standstill);
    ASSERT_TRUE(way) << by_trajectory;
    const WayPoint& end = way->back();
    EXPECT_NEAR(end.v, search.v_min, 1e-2);
    EXPECT_LT(end.t, 15);
    EXPECT_GT(std::sin(end.heading), 0.7) << "the way goes on from there";
    EXPECT_GT(clearance(*way, w.environment.obstacles), 0.8 * search.clearance);
    for (double after = 0; after <= standstill.horizon; after += 0.05) {
      const double on = standstill.creep * after;
      const double x = end.x + on * std::cos(end.heading), y = end.y + on * std::sin(end.heading);
      ASSERT_TRUE(w.environment.region.contains(x, y)) << after;
      ASSERT_GT(distance(w.environment.obstacles[0], x, y, end.t + after), search.clearance)
          << after;
    }
  }
}

TEST(WayFinder, NowhereToStandIsNoWay) {
  auto w = lane_that_fills(false);
  w.environment.obstacles[0].a = 20;
  auto finder = w.finder();
  EXPECT_FALSE(finder.to_stand(w.start, w.t_start, w.environment.obstacles, {.t_max = 80}, {}));
}

}  // namespace
}  // namespace slalom::world
