// Events located in time along drives whose answers are known in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/fakes.hpp"
#include "slalom/world/ellipse.hpp"

namespace slalom::sim {
namespace {

using testing::circle;
using testing::open_field;
using testing::plan_of;
using testing::straight_on;

TEST(Events, HeadOnCrashIsLocatedInTime) {
  auto s = open_field();
  s.obstacles = {circle("far", 30, 0, 3), circle("wall", 0, 40, 3)};
  const Drive d = drive(s, straight_on);
  EXPECT_EQ(d.outcome, Outcome::crash);
  EXPECT_EQ(d.hit, "wall");
  EXPECT_NEAR(d.time, 35. / 17, 1e-9);  // the edge grown by 2 m stands at y = 35
  EXPECT_EQ(d.plant.back().t, d.time);
  EXPECT_NEAR(d.plant.back().state[vehicle::Y], 35, 1e-8);
  EXPECT_NEAR(d.plant.back().clearance, 0, 1e-8);
  EXPECT_NEAR(d.least_clearance, 0, 1e-8);
  EXPECT_EQ(d.least_clearance_obstacle, "wall");
  EXPECT_EQ(d.least_clearance_t, d.time);
}

TEST(Events, CrashIntoAMovingEllipse) {
  auto s = open_field();
  // Comes from the right at 12 m/s: its grown ellipse (6 x 3) is met where
  // ((30 - 12 t)/6)² + ((17 t - 34)/3)² = 1 first holds.
  s.obstacles = {{"bus", 30, 34, 4, 1, -12, 0}};
  const Drive d = drive(s, straight_on);
  const double A = 4 + 17 * 17 / 9., B = -2 * (5 * 2 + 17 * 34 / 9.), C = 25 + 34 * 34 / 9. - 1;
  EXPECT_EQ(d.outcome, Outcome::crash);
  EXPECT_NEAR(d.time, (-B - std::sqrt(B * B - 4 * A * C)) / (2 * A), 1e-9);
}

// The path cuts the grown circle by a micrometre: a chord of 6 mm, where samples are 34 cm apart.
TEST(Events, GrazeBetweenSamplesIsACrash) {
  auto s = open_field();
  const double R = 5, depth = 1e-6;
  for (const double y : {50.03, 50.13, 50.29}) {
    s.obstacles = {circle("cone", R - depth, y, R - 2)};
    const Drive d = drive(s, straight_on);
    ASSERT_EQ(d.outcome, Outcome::crash) << y;
    EXPECT_NEAR(d.time, (y - std::sqrt(R * R - (R - depth) * (R - depth))) / 17, 1e-8);
  }
}

TEST(Events, NearMissIsNotACrashAndItsClearanceIsKept) {
  auto s = open_field();
  s.obstacles = {circle("cone", 5 + 1e-6, 50.13, 3), circle("other", -5.5, 20, 3)};
  const Drive d = drive(s, straight_on);
  EXPECT_EQ(d.outcome, Outcome::timeout);
  EXPECT_NEAR(d.least_clearance, 1e-6, 1e-10);
  EXPECT_NEAR(d.least_clearance_t, 50.13 / 17, 1e-6);
  EXPECT_EQ(d.least_clearance_obstacle, "cone");
}

TEST(Events, FastObstacleCrossingBetweenSamplesIsACrash) {
  auto s = open_field();
  // 400 m/s: 8 m between samples, a bullet of grown radius 2.01 m that meets the path at 1.013 s.
  s.obstacles = {circle("bullet", 400 * 1.013, 17 * 1.013, .01, -400, 0)};
  const Drive d = drive(s, straight_on);
  EXPECT_EQ(d.outcome, Outcome::crash);
  EXPECT_NEAR(d.time, 1.013 - 2.01 / std::hypot(400, 17), 1e-9);
}

TEST(Events, ObstaclesMoveInTheWorldWhateverThePlannerBelieves) {
  auto s = open_field();
  s.planner.moving_avoidance = false;
  s.obstacles = {circle("oncoming", 0, 90, 3, 0, -10)};
  const Drive d = drive(s, straight_on);
  EXPECT_NEAR(d.time, 85. / 27, 1e-9);
}

TEST(Events, EarliestOfSeveralCrashesWins) {
  auto s = open_field();
  s.obstacles = {circle("second", 0, 40.1, 3), circle("first", 0, 40.05, 3),
                 circle("third", 0, 40.15, 3)};
  EXPECT_EQ(drive(s, straight_on).hit, "first");
}

TEST(Events, ClearanceIsSignedDistanceToTheNearestGrownEdgeOrInfinite) {
  auto s = open_field();
  EXPECT_EQ(drive(s, straight_on).least_clearance, std::numeric_limits<double>::infinity());
  s.obstacles = {{"oval", 10, 20, 4, 1, .5, -1}};
  const Drive d = drive(s, straight_on);
  ASSERT_GT(d.plant.size(), 100u);
  for (const auto& p : d.plant)
    EXPECT_NEAR(
        p.clearance,
        world::signed_distance_to_ellipse(p.state[0] - 10 - .5 * p.t, p.state[1] - 20 + p.t, 6, 3),
        1e-12);
}

TEST(Events, GoalEndsTheDriveAtTheCheckAndItsCrossingIsLocated) {
  auto s = open_field();
  s.goal = {1, 40, 1.5, 3};  // square from y = 37 to 43: entered at 2.176 s, checked at 2.5 s
  const Drive d = drive(s, straight_on);
  EXPECT_EQ(d.outcome, Outcome::goal);
  EXPECT_EQ(d.time, 2.5);
  ASSERT_TRUE(d.goal_time);
  EXPECT_NEAR(*d.goal_time, 37. / 17, 1e-9);
  EXPECT_EQ(d.plant.back().t, 2.5);
}

TEST(Events, GoalLeftAgainBeforeTheCheckIsCrossedButNotReached) {
  auto s = open_field();
  s.goal = {1, 40, 1.5, 1.5};  // left at y = 41.5, 2.44 s
  const Drive d = drive(s, straight_on);
  EXPECT_EQ(d.outcome, Outcome::timeout);
  ASSERT_TRUE(d.goal_time);
  EXPECT_NEAR(*d.goal_time, 38.5 / 17, 1e-9);
}

TEST(Events, GoalClippedBetweenSamplesIsCrossed) {
  auto s = open_field();
  s.goal = {0, 40.2, 1.5, .01};  // 2 cm, samples 34 cm apart
  const Drive d = drive(s, straight_on);
  ASSERT_TRUE(d.goal_time);
  EXPECT_NEAR(*d.goal_time, 40.19 / 17, 1e-9);
}

TEST(Events, CrashBeforeTheGoalCheckWins) {
  auto s = open_field();
  s.goal = {1, 40, 1.5, 5};
  // It moves a little, for one that stands in the goal is refused.
  s.obstacles = {circle("in the goal", 0, 45, 3, 1e-12)};  // goal entered at y = 35, hit at y = 40
  const Drive d = drive(s, straight_on);
  EXPECT_EQ(d.outcome, Outcome::crash);
  EXPECT_NEAR(d.time, 40. / 17, 1e-9);
  ASSERT_TRUE(d.goal_time);
  EXPECT_NEAR(*d.goal_time, 35. / 17, 1e-9);
}

TEST(Events, CrossingAfterTheCrashDoesNotCount) {
  auto s = open_field();
  s.obstacles = {circle("wall", 0, 40, 3, 1e-12)};
  s.goal = {0, 35.15, 1.5, .1};  // entered 5 cm behind the crash, within the same stretch
  const Drive d = drive(s, straight_on);
  EXPECT_EQ(d.outcome, Outcome::crash);
  EXPECT_FALSE(d.goal_time);
}

Scenario weaving() {
  auto s = open_field();
  s.vehicle.tyre_asymmetry = true;
  s.loop.timeout = 4;
  return s;
}

TEST(Events, WheelLiftIsLocatedWhereTheLoadFallsBelow) {
  auto s = weaving();
  s.loop.Fz_failure = 5200;
  const Drive d = drive(s, testing::wavy);
  ASSERT_EQ(d.outcome, Outcome::wheel_lift) << d.message;
  const auto& end = d.plant.back();
  EXPECT_EQ(end.t, d.time);
  const double least = *std::min_element(end.wheel_loads.begin(), end.wheel_loads.end());
  EXPECT_NEAR(least, 5200, 1e-4);
  EXPECT_NEAR(d.least_wheel_load, 5200, 1e-4);
  for (std::size_t i = 0; i + 1 < d.plant.size(); ++i)
    for (const double load : d.plant[i].wheel_loads) EXPECT_GE(load, 5200);
  const auto wheel = static_cast<std::size_t>(
      std::min_element(end.wheel_loads.begin(), end.wheel_loads.end()) - end.wheel_loads.begin());
  const char* names[] = {"rear left", "rear right", "front left", "front right"};
  EXPECT_EQ(d.hit, names[wheel]);
}

TEST(Events, WheelLiftBetweenSamplesIsFound) {
  auto s = weaving();
  s.loop.tex = 2;  // one plan, driven from 2 s on without a swap
  const auto swing = [](const planner::Request& r) {
    return plan_of(r, [](double t) { return vehicle::Control{.08 * std::cos(3 * t), 0}; });
  };
  const Drive whole = drive(s, swing);
  double sampled = std::numeric_limits<double>::infinity();
  for (const auto& p : whole.plant)
    for (const double load : p.wheel_loads) sampled = std::min(sampled, load);
  ASSERT_LT(whole.least_wheel_load, sampled - 1e-3);  // the dip lies between two samples
  EXPECT_GT(whole.least_wheel_load, sampled - 20);
  s.loop.Fz_failure = (whole.least_wheel_load + sampled) / 2;
  const Drive d = drive(s, swing);
  EXPECT_EQ(d.outcome, Outcome::wheel_lift);
  EXPECT_NEAR(d.least_wheel_load, s.loop.Fz_failure, 1e-6);
}

}  // namespace
}  // namespace slalom::sim
