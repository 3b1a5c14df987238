#include "../../src/sim/course.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "sim/fakes.hpp"
#include "slalom/sim/watch.hpp"

namespace slalom::sim {
namespace {

using vehicle::Plant;
using vehicle::State;

const State kStart = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};

const Plant& plant() {
  static const Plant plant(testing::open_field().vehicle, 1e-9, 0.02);
  return plant;
}

TEST(Course, AsksThePlantOnceForATime) {
  std::vector<double> asked;
  const Stretch stretch{2, 2.02, kStart, kStart, [&](double t) {
                          asked.push_back(t);
                          State state = kStart;
                          state[vehicle::AX] = t;
                          return state;
                        }};
  const auto& dynamics = plant().dynamics();
  Course course(stretch, dynamics, Instant(2, kStart, dynamics), Instant(2.02, kStart, dynamics));
  for (int again = 0; again < 3; ++again)
    for (const double t : {2.01, 2.001}) {
      EXPECT_EQ(course.at(t)[vehicle::AX], t);
      EXPECT_EQ(course.loads(t), dynamics.wheel_loads(course.at(t)));
    }
  course.end_at(2.01);
  EXPECT_EQ(course.end().state[vehicle::AX], 2.01);
  EXPECT_NEAR(course.length(), 0.01, 1e-12);
  EXPECT_EQ(asked, (std::vector<double>{2.01, 2.001}));
}

/// What a signal's path is judged as among obstacles.
struct Seen {
  std::optional<Event> event;
  double least_clearance, last_clearance;
};

Seen seen(const Criteria& criteria, const vehicle::ControlSignal& signal, double t_end) {
  Watch watch(criteria, plant().dynamics());
  State state = kStart;
  double t = 0;
  watch.begin(t, state);
  for (const double t1 : plant().instants(signal, 0, t_end)) {
    const auto stretch = Stretch::driven(plant(), signal, state, t, t1);
    if (const auto event = watch.pass(stretch))
      return {event, watch.least_clearance(), watch.clearance(event->t, stretch.at(event->t))};
    state = stretch.state1;
    t = t1;
    EXPECT_EQ(watch.wheel_loads(state), plant().dynamics().wheel_loads(state));
  }
  return {{}, watch.least_clearance(), watch.clearance(t, state)};
}

world::Obstacle some_obstacle(std::mt19937& random, int k) {
  std::uniform_real_distribution<double> at(-1, 1);
  world::Obstacle o = testing::circle("o", 8 * at(random), 8 + 10 * at(random), 1);
  o.name += std::to_string(k);
  o.a += at(random) / 2;
  o.vx = 3 * at(random);
  o.vy = 3 * at(random);
  if (k % 3 == 1) o.psi = at(random);
  if (k % 3 == 2) o.outline = std::make_shared<world::Polygon>(world::Polygon::rectangle(1, 2));
  if (k % 3 == 2) o.a = o.b = o.outline->reach();
  return o;
}

// Those that are too far off to matter are passed over, which changes nothing.
TEST(Watch, ManyObstaclesAreJudgedAsEachAlone) {
  const vehicle::ControlSignal signal({0, 1, 3}, {{0.06, 1}, {-0.07, 0}, {0, 0}});
  int crashes = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    Criteria all;
    if (seed % 2 == 1) {
      auto car = testing::open_field().vehicle;
      car.footprint = vehicle::FootprintKind::rectangle;
      all.footprint = world::Footprint(car);
    }
    all.margin = 0.1;
    for (int k = 0; k < 6; ++k) all.obstacles.push_back(some_obstacle(random, k));
    const Seen together = seen(all, signal, 0.7);
    const double t_end = together.event ? together.event->t : 0.7;
    std::optional<Event> first;
    double least = std::numeric_limits<double>::infinity(), last = least;
    for (const auto& o : all.obstacles) {
      Criteria one = all;
      one.obstacles = {o};
      const Seen alone = seen(one, signal, 0.7);
      if (alone.event && (!first || alone.event->t < first->t)) first = alone.event;
    }
    ASSERT_EQ(first.has_value(), together.event.has_value()) << seed;
    if (first) {
      ++crashes;
      EXPECT_EQ(first->what, together.event->what);
      EXPECT_EQ(first->t, together.event->t);
      continue;
    }
    for (const auto& o : all.obstacles) {
      Criteria one = all;
      one.obstacles = {o};
      const Seen alone = seen(one, signal, t_end);
      least = std::min(least, alone.least_clearance);
      last = std::min(last, alone.last_clearance);
    }
    EXPECT_NEAR(together.least_clearance, least, 1e-3) << seed << ": shapes are found to 1 mm";
    EXPECT_EQ(together.last_clearance, last) << seed;
  }
  EXPECT_GT(crashes, 0);
  EXPECT_LT(crashes, 6);
}

}  // namespace
}  // namespace slalom::sim
