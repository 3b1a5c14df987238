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
      EXPECT_TRUE(world::path_exists(scenario, scenario.vehicle, scenario.start));
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

/// Whether something comes within 2 m of a vehicle that goes straight on at `speed`.
bool in_the_way(const sim::Scenario& s, double speed) {
  for (double t = 0; speed * t < s.goal.y; t += 0.01)
    for (const auto& o : s.obstacles)
      if (world::distance(o, 0, speed * t, t) < 2) return true;
  return false;
}

TEST(TimedFamilies, LetNobodyDriveStraightOn) {
  for (const auto* family : {"two_oncoming", "overtaking", "crossing_at_rest"}) {
    const auto s = make_scenario(family, {1, 1, 0.6});
    SCOPED_TRACE(s.name);
    EXPECT_TRUE(in_the_way(s, 17));
  }
}

TEST(TimedFamilies, TwoOncomingFillWhatTheNarrowingLeaves) {
  const auto s = make_scenario("two_oncoming", {1, 1, 1});
  ASSERT_EQ(s.obstacles.size(), 3u);
  const auto& closed = s.obstacles[0];
  EXPECT_FALSE(closed.moves());
  for (const auto* o : {&s.obstacles[1], &s.obstacles[2]}) {
    EXPECT_LT(o->vy, -8);
    const double t = (closed.y - o->y) / o->vy;
    EXPECT_GT(t, 0);
    for (double x = s.region.x_min; x <= s.region.x_max; x += 0.1) {
      const bool closed_here = world::distance(closed, x, closed.y, t) < 2.5;
      EXPECT_TRUE(closed_here || world::distance(*o, x, closed.y, t) < 2.5) << x;
    }
  }
  EXPECT_NE(s.obstacles[1].vy, s.obstacles[2].vy);
}

TEST(TimedFamilies, OvertakersComeFromBehindFasterThanTheVehicle) {
  for (int index = 1; index <= 10; ++index) {
    const auto s = make_scenario("overtaking", {1, index, 1});
    SCOPED_TRACE(s.name);
    ASSERT_EQ(s.obstacles.size(), 5u);
    EXPECT_LT(s.obstacles[0].vy, 6);
    for (std::size_t i = 1; i < s.obstacles.size(); ++i) {
      EXPECT_LT(s.obstacles[i].y, 0);
      EXPECT_GT(s.obstacles[i].vy, 17);
    }
  }
}

TEST(TimedFamilies, NoSteadySpeedLeadsThroughTheGapBeforeItIsFree) {
  for (int index = 1; index <= 2; ++index) {
    const auto s = make_scenario("crossing_at_rest", {1, index, 0});
    SCOPED_TRACE(s.name);
    const auto &left = s.obstacles[0], &right = s.obstacles[1];
    const double gap = (left.x + right.x) / 2, half = (right.x - right.a) - gap;
    EXPECT_GE(half, 4.5);
    for (double speed = 15; speed <= 22; speed += 0.5) {
      bool filled = false;
      for (double y = left.y - 5; y < left.y + 10; y += 0.2)
        for (const auto& o : s.obstacles)
          filled = filled || (o.moves() && world::distance(o, gap, y, y / speed) < 2);
      EXPECT_TRUE(filled) << speed;
    }
  }
}

/// Draws depend on a family's place among them, so that new ones stand at the end.
TEST(Families, KeepTheirPlaces) {
  std::vector<std::string> names;
  for (const auto& family : families()) names.push_back(family.name);
  EXPECT_EQ(names, (std::vector<std::string>{"static_field", "moving_field", "crossing", "oncoming",
                                             "slalom", "double_lane_change", "gates", "dead_ends",
                                             "two_oncoming", "overtaking", "crossing_at_rest"}));
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

}  // namespace
}  // namespace slalom::sweep
