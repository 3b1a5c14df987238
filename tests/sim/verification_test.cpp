#include "slalom/sim/verification.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/fakes.hpp"
#include "slalom/sim/marks.hpp"

namespace slalom::sim {
namespace {

constexpr double kSpeed = 17;  // of testing::open_field()

/// Straight on at the start's speed, and said to be verified.
planner::Plan verified_straight_on(const planner::Request& request) {
  auto plan = testing::straight_on(request);
  for (std::size_t k = 0; k < plan.t.size(); ++k) plan.states[k][vehicle::Y] += kSpeed * plan.t[k];
  plan.rung = planner::Rung::new_plan;
  plan.certificate.verified = true;
  plan.certificate.least_clearance = 2.8;
  plan.certificate.proved_clearance = 2.5;
  return plan;
}

/// Something 60 m ahead that goes on at 4 m/s and is taken to go at 2 m/s: hit at 57/13 s by the
/// plan of the cycle that began at 3.5 s.
Scenario behind_a_cyclist() {
  auto s = testing::open_field();
  s.obstacles = {testing::circle("cyclist", 0, 60, 1, 0, 4)};
  s.sensing.obstacle_velocity_factor = 0.5;
  s.loop.tex = 0.5;
  return s;
}

TEST(VerifiedCrash, SaysWhatWasNotAsBelieved) {
  const auto s = behind_a_cyclist();
  const auto d = drive(s, verified_straight_on);
  ASSERT_EQ(d.outcome, Outcome::crash) << d.message;
  ASSERT_NEAR(d.time, 57 / 13., 1e-6);
  const auto crash = verified_crash(s, d);
  ASSERT_TRUE(crash);
  EXPECT_EQ(d.cycles.at(static_cast<std::size_t>(crash->cycle) - 1).t0, 3.5);
  EXPECT_DOUBLE_EQ(crash->kept, 0.5);
  EXPECT_NEAR(crash->off_plan, 0, 1e-6);
  ASSERT_TRUE(crash->off_belief);
  EXPECT_NEAR(*crash->off_belief, 2 * (57 / 13. - 3.5), 1e-6);
  const auto all = marks(s, d);
  const auto mark = std::find_if(all.begin(), all.end(),
                                 [](const Mark& m) { return m.kind == "verified_crash"; });
  ASSERT_NE(mark, all.end());
  EXPECT_NE(mark->text.find("cyclist 1.77 m from where it was believed"), std::string::npos)
      << mark->text;
}

TEST(VerifiedCrash, OfAVehicleThatIsOffItsPlan) {
  auto s = behind_a_cyclist();
  const auto d = drive(s, [](const planner::Request& request) {
    auto plan = verified_straight_on(request);
    for (auto& x : plan.states) x[vehicle::X] += 0.25;
    return plan;
  });
  const auto crash = verified_crash(s, d);
  ASSERT_TRUE(crash);
  EXPECT_NEAR(crash->off_plan, 0.25, 1e-6);
}

TEST(VerifiedCrash, IntoWhatThePlannerDidNotKnow) {
  auto s = behind_a_cyclist();
  s.planner.known = planner::Known::range;
  s.planner.L_range = 10;  // at 3.5 s it is 13.5 m ahead
  const auto d = drive(s, verified_straight_on);
  const auto crash = verified_crash(s, d);
  ASSERT_TRUE(crash);
  EXPECT_FALSE(crash->off_belief);
}

TEST(VerifiedCrash, NothingForOtherEndsAndPlans) {
  auto s = behind_a_cyclist();
  EXPECT_FALSE(verified_crash(s, drive(s, testing::straight_on)));
  s.obstacles.clear();
  EXPECT_FALSE(verified_crash(s, drive(s, verified_straight_on)));
}

}  // namespace
}  // namespace slalom::sim
