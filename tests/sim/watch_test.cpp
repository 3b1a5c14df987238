// A signal rolled out on a plant and watched, without a loop or a scenario.

#include "slalom/sim/watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/fakes.hpp"

namespace slalom::sim {
namespace {

using vehicle::ControlSignal;
using vehicle::Plant;

/// Straight on northwards from the origin at 17 m/s for 4 s, or up to the first event.
struct Watched {
  std::optional<Event> event;
  double least_clearance, least_clearance_t, least_wheel_load;
  std::optional<double> goal_time;
};

Watched watched(const Criteria& criteria) {
  const Plant plant(testing::open_field().vehicle, 1e-9, 0.02);
  const ControlSignal signal;
  Watch watch(criteria, plant.dynamics());
  vehicle::State state = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};
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

}  // namespace
}  // namespace slalom::sim
