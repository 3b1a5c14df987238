#include "slalom/world/path_exists.hpp"
#include "world/box.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

namespace slalom::world {
namespace {

using test::box;

/// Northwards at 17 m/s.
const vehicle::Parameters kVehicle;
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
  EXPECT_TRUE(path_exists(s, kVehicle, kStart));
  s.obstacles = {{"wall", 0, 50, 12, 1, 0, 0}};
  EXPECT_FALSE(path_exists(s, kVehicle, kStart));
  s.obstacles = {{"left", -8, 50, 8, 1, 0, 0}, {"right", 8.5, 50, 4, 1, 0, 0}};
  EXPECT_FALSE(path_exists(s, kVehicle, kStart)) << "4.5 m between edges, 5 m of margins";
  s.obstacles[1].x = 14;
  EXPECT_TRUE(path_exists(s, kVehicle, kStart));
}

TEST(PathExists, CountsWhereObstaclesAreByThen) {
  auto s = open_way();
  s.obstacles = {{"wall", 0, 50, 12, 1, 12, 0}};  // has gone to the east in two seconds
  EXPECT_TRUE(path_exists(s, kVehicle, kStart));
  s.obstacles = {{"wall", 0, 95, 14, 1, 0, -10}};  // sweeps over all of the way
  EXPECT_FALSE(path_exists(s, kVehicle, kStart));
}

TEST(PathExists, TurnsAndBrakesAsAVehicleCan) {
  auto s = open_way();
  s.obstacles = {{"wall", -4, 60, 8, 1, 0, 0}};  // 6 m aside at least
  EXPECT_TRUE(path_exists(s, kVehicle, kStart));
  s.obstacles[0].y = 24;
  EXPECT_FALSE(path_exists(s, kVehicle, kStart)) << "too near at 17 m/s";
  EXPECT_TRUE(
      path_exists(s, kVehicle, kStart, {.lateral_acceleration = 12, .curvature_rate = 0.1}));
}

TEST(PathExists, StaysInTheRegionAndReachesTheGoalInTime) {
  auto s = open_way();
  s.goal.x = 40;
  EXPECT_FALSE(path_exists(s, kVehicle, kStart)) << "the region ends before the goal's square";
  s = open_way();
  EXPECT_FALSE(path_exists(s, kVehicle, kStart, {.t_max = 3})) << "90 m from 17 m/s on";
  EXPECT_TRUE(path_exists(s, kVehicle, kStart, {.t_max = 6}));
}

TEST(PathExists, KeepsTheVehiclesBodyInTheRegion) {
  auto s = open_way();
  s.obstacles = {{"wall", -1.4, 50, 9.6, 1, 0, 0}};  // 1.8 m are left in the east
  auto body = kVehicle;
  body.footprint = vehicle::FootprintKind::rectangle;  // 2 m wide
  EXPECT_TRUE(path_exists(s, kVehicle, kStart, {.clearance = 0}));
  EXPECT_FALSE(path_exists(s, body, kStart, {.clearance = 0}));
  s.obstacles[0].x = -3;
  EXPECT_TRUE(path_exists(s, body, kStart, {.clearance = 0}));
  auto beside = kStart;
  beside[vehicle::X] = 8.95;  // 5 cm of the region beside it
  EXPECT_TRUE(path_exists(s, body, beside, {.clearance = 0}));
}

TEST(PathExists, BetweenBoxesAsFarAsTheVehiclesBodyFits) {
  auto s = open_way();
  const double right = std::numbers::pi / 2;
  s.obstacles = {box(-8, 50, 4, 14, right), box(10, 50, 4, 14, right)};  // 4 m from x = -1 to 3
  EXPECT_FALSE(path_exists(s, kVehicle, kStart));
  EXPECT_TRUE(path_exists(s, kVehicle, kStart, {.clearance = 1.2}));
  auto body = kVehicle;
  body.footprint = vehicle::FootprintKind::rectangle;  // 2 m wide
  EXPECT_FALSE(path_exists(s, body, kStart, {.clearance = 1.2}));
  EXPECT_TRUE(path_exists(s, body, kStart, {.clearance = 0.3}));
  s.obstacles[0].psi = s.obstacles[1].psi = 0;  // 14 m
  EXPECT_TRUE(path_exists(s, body, kStart, {.clearance = 1.2}));
}

TEST(PathExists, PastATableWhileItIsThere) {
  auto s = open_way();
  s.obstacles = {box(0, 0, 24, 2, 0)};
  const auto until = [&](double t, BeyondEnd after) {
    s.obstacles[0].trajectory = std::make_shared<TableTrajectory>(
        std::vector<TrajectoryRow>{{0, 0, 60, 0}, {t, 0, 60, 0}}, BeyondEnd::stands, after, "wall");
    return path_exists(s, kVehicle, kStart, {.t_max = 12});
  };
  EXPECT_FALSE(until(3, BeyondEnd::stands));
  EXPECT_TRUE(until(3, BeyondEnd::absent));
  EXPECT_FALSE(until(30, BeyondEnd::absent));
}

}  // namespace
}  // namespace slalom::world
