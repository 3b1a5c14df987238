// Random scenarios, and the search that says whether there is a way through them.

#include "slalom/sweep/families.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slalom/base/error.hpp"
#include "slalom/sim/closed_loop.hpp"
#include "slalom/world/path_exists.hpp"

namespace slalom::sweep {
namespace {

bool same(const sim::Scenario& a, const sim::Scenario& b) {
  if (a.obstacles.size() != b.obstacles.size()) return false;
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    const auto &p = a.obstacles[i], &q = b.obstacles[i];
    if (p.x != q.x || p.y != q.y || p.a != q.a || p.b != q.b || p.vx != q.vx || p.vy != q.vy)
      return false;
  }
  return true;
}

TEST(Families, AreTheSameForTheSameNumbersAndDifferOtherwise) {
  for (const auto& family : families()) {
    SCOPED_TRACE(family.name);
    const auto one = make_scenario(family.name, {.seed = 3, .index = 2, .difficulty = 0.5});
    EXPECT_TRUE(same(one, make_scenario(family.name, {3, 2, 0.5})));
    EXPECT_FALSE(same(one, make_scenario(family.name, {3, 1, 0.5})));
    EXPECT_FALSE(same(one, make_scenario(family.name, {3, 2, 0.9})));
    EXPECT_EQ(one.name, family.name + "-0002");
  }
}

TEST(Families, AnotherSeedGivesOthers) {
  EXPECT_FALSE(same(make_scenario("gates", {3, 2, 0.5}), make_scenario("gates", {4, 2, 0.5})));
}

TEST(Families, HaveAWayAndAStartThatMayBeDrivenAtEveryDifficulty) {
  for (const auto& family : families())
    for (const double difficulty : {0.0, 1.0}) {
      SCOPED_TRACE(family.name);
      const auto scenario = make_scenario(family.name, {1, 1, difficulty});
      EXPECT_NO_THROW(sim::check(scenario, "made"));
      EXPECT_TRUE(world::path_exists(scenario));
      EXPECT_FALSE(scenario.obstacles.empty());
    }
}

/// Drawn once and pinned: a change of the dice is a change of every study made with them.
TEST(Families, AreTheSameOnEveryMachine) {
  const auto s = make_scenario("static_field", {7, 1, 0});
  ASSERT_EQ(s.obstacles.size(), 3u);
  EXPECT_DOUBLE_EQ(s.obstacles[0].x, 16.52643498498086);
  EXPECT_DOUBLE_EQ(s.obstacles[0].a, 1.3059842639138313);
}

std::string message(const std::string& family, double difficulty) {
  try {
    (void)make_scenario(family, {1, 1, difficulty});
  } catch (const InvalidValue& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Families, RefuseUnknownNamesAndDifficulties) {
  EXPECT_NE(message("gate", 0.5).find("did you mean 'gates'?"), std::string::npos);
  EXPECT_NE(message("gates", 1.5).find("a number from 0 to 1"), std::string::npos);
  EXPECT_NE(message("gates", std::nan("")).find("nan"), std::string::npos);
}

sim::Scenario open_way() {
  sim::Scenario s;
  s.start = {0, 0, 0, 0, 1.5707963267948966, 0, 17, 0};
  s.goal = {0, 100, 1.5707963267948966, 10};
  s.region.x_min = -10;
  s.region.x_max = 10;
  return s;
}

TEST(PathExists, NotThroughAWallNorAGapTooNarrow) {
  auto s = open_way();
  EXPECT_TRUE(world::path_exists(s));
  s.obstacles = {{"wall", 0, 50, 12, 1, 0, 0}};
  EXPECT_FALSE(world::path_exists(s));
  s.obstacles = {{"left", -8, 50, 8, 1, 0, 0}, {"right", 8.5, 50, 4, 1, 0, 0}};
  EXPECT_FALSE(world::path_exists(s)) << "4.5 m between edges, 5 m of margins";
  s.obstacles[1].x = 14;
  EXPECT_TRUE(world::path_exists(s));
}

TEST(PathExists, CountsWhereObstaclesAreByThen) {
  auto s = open_way();
  s.obstacles = {{"wall", 0, 50, 12, 1, 12, 0}};  // has gone to the east in two seconds
  EXPECT_TRUE(world::path_exists(s));
  s.obstacles = {{"wall", 0, 95, 14, 1, 0, -10}};  // sweeps over all of the way
  EXPECT_FALSE(world::path_exists(s));
}

TEST(PathExists, TurnsAndBrakesAsAVehicleCan) {
  auto s = open_way();
  s.obstacles = {{"wall", -4, 60, 8, 1, 0, 0}};  // 6 m aside at least
  EXPECT_TRUE(world::path_exists(s));
  s.obstacles[0].y = 24;
  EXPECT_FALSE(world::path_exists(s)) << "too near at 17 m/s";
  EXPECT_TRUE(world::path_exists(s, {.lateral_acceleration = 12, .curvature_rate = 0.1}));
}

TEST(PathExists, StaysInTheRegionAndReachesTheGoalInTime) {
  auto s = open_way();
  s.goal.x = 40;
  EXPECT_FALSE(world::path_exists(s)) << "the region ends before the goal's square";
  s = open_way();
  EXPECT_FALSE(world::path_exists(s, {.t_max = 3})) << "90 m from 17 m/s on";
  EXPECT_TRUE(world::path_exists(s, {.t_max = 6}));
}

}  // namespace
}  // namespace slalom::sweep
