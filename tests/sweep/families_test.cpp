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
      EXPECT_TRUE(world::path_exists(scenario, scenario.start));
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

}  // namespace
}  // namespace slalom::sweep
