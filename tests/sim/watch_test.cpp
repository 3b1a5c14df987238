// A signal rolled out on a plant and watched, without a loop or a scenario.

#include "slalom/sim/watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "sim/fakes.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::sim {
namespace {

using vehicle::ControlSignal;
using vehicle::Plant;
using vehicle::State;

/// On a signal northwards from the origin at 17 m/s for 4 s, or up to the first event.
struct Watched {
  std::optional<Event> event;
  double least_clearance, least_clearance_t, least_wheel_load;
  std::optional<double> goal_time;
};

const State kStart = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};

const Plant& symmetric_plant() {
  static const Plant plant(testing::open_field().vehicle, 1e-9, 0.02);
  return plant;
}

Watched watched(const Criteria& criteria, const ControlSignal& signal = {}) {
  const Plant& plant = symmetric_plant();
  Watch watch(criteria, plant.dynamics());
  State state = kStart;
  double t = 0;
  watch.begin(t, state);
  std::optional<Event> event;
  for (const double t1 : plant.instants(signal, 0, 4)) {
    const auto stretch = Stretch::driven(plant, signal, state, t, t1);
    event = watch.pass(stretch);
    if (event) break;
    state = stretch.state1;
    t = t1;
  }
  return {event, watch.least_clearance(), watch.least_clearance_t(), watch.least_wheel_load(),
          watch.goal_time()};
}

world::Footprint body() {
  auto car = testing::open_field().vehicle;
  car.footprint = vehicle::FootprintKind::rectangle;
  return world::Footprint(car);
}

/// A square of 2 m across its corners that stands on one of them; its western one at (x, y).
world::Obstacle diamond(double x, double y) {
  const auto square = world::Polygon({{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, "diamond");
  world::Obstacle o{"diamond", x + 1, y};
  o.outline = std::make_shared<world::Polygon>(square);
  o.a = o.b = square.reach();
  return o;
}

world::Obstacle by_table(world::Obstacle o, std::vector<world::TrajectoryRow> rows,
                         world::BeyondEnd ends = world::BeyondEnd::stands) {
  o.trajectory = std::make_shared<world::TableTrajectory>(std::move(rows), ends, ends, o.name);
  return o;
}

TEST(Watch, ObstaclesGrowByTheMarginItIsGiven) {
  Criteria criteria;
  criteria.obstacles = {testing::circle("cone", 5, 40, 3)};
  criteria.goal = {0, 60, std::numbers::pi / 2, 2};
  for (const double margin : {0., 1.5}) {
    criteria.margin = margin;
    const auto passed = watched(criteria);
    EXPECT_FALSE(passed.event);
    EXPECT_NEAR(passed.least_clearance, 2 - margin, 1e-9);
    EXPECT_NEAR(passed.least_clearance_t, 40. / 17, 1e-6);
    ASSERT_TRUE(passed.goal_time);
    EXPECT_NEAR(*passed.goal_time, 58. / 17, 1e-9);
    EXPECT_GT(passed.least_wheel_load, 4000);
  }
  criteria.margin = 2.5;
  const auto hit = watched(criteria);
  ASSERT_TRUE(hit.event);
  EXPECT_EQ(hit.event->outcome, Outcome::crash);
  EXPECT_NEAR(hit.event->t, (40 - std::sqrt(5.5 * 5.5 - 25)) / 17, 1e-9);
  EXPECT_FALSE(hit.goal_time);
}

TEST(Watch, AWheelLiftsBelowTheLoadItIsGiven) {
  Criteria criteria;
  const double least = watched(criteria).least_wheel_load;
  criteria.Fz_failure = least - 1;
  EXPECT_FALSE(watched(criteria).event);
  criteria.Fz_failure = least + 1;
  const auto lifted = watched(criteria).event;
  ASSERT_TRUE(lifted);
  EXPECT_EQ(lifted->outcome, Outcome::wheel_lift);
}

// The body's side lies at x = 1, its front 0.649 m ahead of the axle; samples are 34 cm apart.
TEST(Watch, ABodysCornerMeetsABoxsCornerBetweenTwoSamples) {
  Criteria criteria;
  criteria.footprint = body();
  const double depth = 1e-3;
  for (const double y : {50.03, 50.13, 50.29}) {
    criteria.obstacles = {diamond(1 - depth, y)};
    const auto hit = watched(criteria).event;
    ASSERT_TRUE(hit) << y;
    EXPECT_EQ(hit->what, "diamond");
    EXPECT_NEAR(hit->t, (y - depth - 0.649) / 17, 1e-9);
    criteria.obstacles = {diamond(1 + depth, y)};
    const auto passed = watched(criteria);
    EXPECT_FALSE(passed.event) << y;
    EXPECT_NEAR(passed.least_clearance, depth, 1e-9);
    // For a point both are far off.
    Criteria point;
    point.obstacles = {diamond(1 - depth, y)};
    EXPECT_NEAR(watched(point).least_clearance, 1 - depth, 1e-9);
  }
}

TEST(Watch, AGrazeOfABodyATenthOfAMillimetreDeepIsSeen) {
  Criteria criteria;
  criteria.footprint = body();
  const double depth = 1e-4;
  for (const double y : {50.03, 50.13, 50.29}) {
    criteria.obstacles = {diamond(1 - depth, y)};
    ASSERT_TRUE(watched(criteria).event) << y;
  }
}

// Two dashes towards the vehicle's path within the one stretch from 2 s to 2.02 s: of the second
// alone, or of the first, the edge comes across the path.
TEST(Watch, AContactInOneOfTwoDashesWithinAStretchIsFound) {
  Criteria criteria;
  const auto dashing = [&](double first, double second) {
    const world::Obstacle post = testing::circle("post", 0, 0, 1);
    return by_table(post, {{1, 9, 34.17},
                           {2.0015, 5, 34.17},
                           {2.004, first, 34.17},
                           {2.0085, 5, 34.17},
                           {2.013, second, 34.17},
                           {2.0175, 5, 34.17},
                           {3, 9, 34.17}});
  };
  for (const auto& [first, second] : {std::pair{0.9, 1.2}, {1.2, 0.9}, {1.3, 0.95}, {0.95, 0.9}}) {
    criteria.obstacles = {dashing(first, second)};
    const auto hit = watched(criteria).event;
    ASSERT_TRUE(hit) << first << " " << second;
    double t = 2;
    while (world::distance(criteria.obstacles[0], 0, 17 * t, t) >= 0 && t < 2.02) t += 1e-7;
    EXPECT_NEAR(hit->t, t, 2e-7) << first << " " << second;
  }
  criteria.obstacles = {dashing(1.2, 1.3)};
  const auto missed = watched(criteria);
  EXPECT_FALSE(missed.event);
  double least = 1;
  for (double t = 2; t < 2.02; t += 1e-6)
    least = std::min(least, world::distance(criteria.obstacles[0], 0, 17 * t, t));
  EXPECT_NEAR(missed.least_clearance, least, 1e-3);
}

TEST(Watch, AnObstacleOfAbsurdSpeedIsWatchedInGoodTime) {
  Criteria criteria;
  criteria.obstacles = {by_table(testing::circle("leaps", 0, 0, 1),
                                 {{1, 1e6, 9}, {1.01, -1e6, 9}, {1.5, 1e300, 0}, {1.6, 50, 9}})};
  EXPECT_NO_THROW((void)watched(criteria));
}

TEST(Watch, WhatAppearsUponTheVehicleIsACrashAtThatMoment) {
  Criteria criteria;
  const auto there = [](double from, double to, double y) {
    return by_table(testing::circle("ghost", 0, 0, 3), {{from, 0, y}, {to, 0, y}},
                    world::BeyondEnd::absent);
  };
  for (const double from : {1.993, 2., 2.0131}) {
    criteria.obstacles = {there(from, 9, 34)};
    const auto hit = watched(criteria).event;
    ASSERT_TRUE(hit) << from;
    EXPECT_NEAR(hit->t, from, 1e-9);
  }
  // Gone when the vehicle comes, and only then.
  criteria.obstacles = {there(0, 1.7, 34)};
  auto passed = watched(criteria);
  EXPECT_FALSE(passed.event);
  EXPECT_NEAR(passed.least_clearance, 34 - 3 - 17 * 1.7, 1e-8);
  EXPECT_NEAR(passed.least_clearance_t, 1.7, 1e-9);
  criteria.obstacles = {there(0, 1.9, 34)};
  ASSERT_TRUE(watched(criteria).event);
  EXPECT_NEAR(watched(criteria).event->t, 31. / 17, 1e-9);
  // There only behind it.
  criteria.obstacles = {there(3, 9, 34)};
  passed = watched(criteria);
  EXPECT_FALSE(passed.event);
  EXPECT_NEAR(passed.least_clearance, 17 * 3 - 34 - 3, 1e-8);
  const Watch watch(criteria, symmetric_plant().dynamics());
  EXPECT_EQ(watch.clearance(2, kStart), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(watch.clearance(3, kStart), 31, 1e-12);
}

TEST(Watch, LeastDistancesOfATurningBodyAreThoseOfADenseSearch) {
  const ControlSignal signal({0, 1, 2, 3, 4}, {{.08, 0}, {-.08, 1}, {.08, -2}, {0, 0}, {-.08, 0}});
  Criteria criteria;
  criteria.footprint = body();
  criteria.obstacles = {
      by_table(diamond(0, 0), {{0, 8, 20, 0}, {1, 7, 30, 1}, {2, 6, 36, 2}, {4, 0, 60, 5}})};
  const auto passed = watched(criteria, signal);
  ASSERT_FALSE(passed.event);
  double least = 1e9, at = 0;
  State state = kStart;
  double t0 = 0;
  for (const double t1 : symmetric_plant().instants(signal, 0, 4)) {
    for (int k = 0; k < 40; ++k) {
      const double t = t0 + (t1 - t0) * k / 40;
      const double d = criteria.footprint.distance(
          criteria.obstacles[0], symmetric_plant().advance(state, signal, t0, t), t);
      if (d < least) at = t;
      least = std::min(least, d);
    }
    state = symmetric_plant().advance(state, signal, t0, t1);
    t0 = t1;
  }
  EXPECT_GT(least, 0.1);
  EXPECT_LT(least, 4);
  EXPECT_NEAR(passed.least_clearance, least, 1e-3);
  EXPECT_NEAR(passed.least_clearance_t, at, 0.05);
  criteria.margin = least + 0.01;
  const auto hit = watched(criteria, signal).event;
  ASSERT_TRUE(hit);
  EXPECT_LT(hit->t, at);
}

}  // namespace
}  // namespace slalom::sim
