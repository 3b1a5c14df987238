#include "slalom/world/path_exists.hpp"

#include <gtest/gtest.h>

namespace slalom::world {
namespace {

/// Northwards at 17 m/s.
constexpr vehicle::State kStart = {0, 0, 0, 0, 1.5707963267948966, 0, 17, 0};

Environment open_way() {
  Environment s;
  s.goal = {0, 100, 1.5707963267948966, 10};
  s.region.x_min = -10;
  s.region.x_max = 10;
  return s;
}

TEST(PathExists, NotThroughAWallNorAGapTooNarrow) {
  auto s = open_way();
  EXPECT_TRUE(path_exists(s, kStart));
  s.obstacles = {{"wall", 0, 50, 12, 1, 0, 0}};
  EXPECT_FALSE(path_exists(s, kStart));
  s.obstacles = {{"left", -8, 50, 8, 1, 0, 0}, {"right", 8.5, 50, 4, 1, 0, 0}};
  EXPECT_FALSE(path_exists(s, kStart)) << "4.5 m between edges, 5 m of margins";
  s.obstacles[1].x = 14;
  EXPECT_TRUE(path_exists(s, kStart));
}

TEST(PathExists, CountsWhereObstaclesAreByThen) {
  auto s = open_way();
  s.obstacles = {{"wall", 0, 50, 12, 1, 12, 0}};  // has gone to the east in two seconds
  EXPECT_TRUE(path_exists(s, kStart));
  s.obstacles = {{"wall", 0, 95, 14, 1, 0, -10}};  // sweeps over all of the way
  EXPECT_FALSE(path_exists(s, kStart));
}

TEST(PathExists, TurnsAndBrakesAsAVehicleCan) {
  auto s = open_way();
  s.obstacles = {{"wall", -4, 60, 8, 1, 0, 0}};  // 6 m aside at least
  EXPECT_TRUE(path_exists(s, kStart));
  s.obstacles[0].y = 24;
  EXPECT_FALSE(path_exists(s, kStart)) << "too near at 17 m/s";
  EXPECT_TRUE(path_exists(s, kStart, {.lateral_acceleration = 12, .curvature_rate = 0.1}));
}

TEST(PathExists, StaysInTheRegionAndReachesTheGoalInTime) {
  auto s = open_way();
  s.goal.x = 40;
  EXPECT_FALSE(path_exists(s, kStart)) << "the region ends before the goal's square";
  s = open_way();
  EXPECT_FALSE(path_exists(s, kStart, {.t_max = 3})) << "90 m from 17 m/s on";
  EXPECT_TRUE(path_exists(s, kStart, {.t_max = 6}));
}

}  // namespace
}  // namespace slalom::world
