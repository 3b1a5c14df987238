#include "slalom/world/way_signature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace slalom::world {
namespace {

constexpr double kPi = std::numbers::pi;

/// Northwards from (0, 0) to (0, 100), aside by `aside` in the middle, its places reached after
/// the times of y = `schedule`(t).
template <class Schedule>
Way way(double aside, double t_end, Schedule schedule) {
  Way result;
  for (int k = 0; k <= 400; ++k) {
    const double t = t_end * k / 400, y = schedule(t);
    result.push_back({t, aside * std::sin(kPi * y / 100), y});
  }
  return result;
}
Way steady(double aside) {
  return way(aside, 10, [](double t) { return 10 * t; });
}

TEST(WaySignature, TellsTheSideOfWhatStands) {
  const std::vector<Obstacle> rock = {{"rock", 0, 50, 2, 2, 0, 0}};
  const auto left = signature(steady(-6), rock), right = signature(steady(6), rock);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_NEAR(left[0].swept, -kPi, 1e-9) << "to its west: clockwise, seen from the way";
  EXPECT_NEAR(right[0].swept, kPi, 1e-9);
  EXPECT_NEAR(left[0].nearest, 6, 1e-9);
  EXPECT_NEAR(left[0].when, 5, 1e-9);
  EXPECT_TRUE(differ(left, right));
  EXPECT_FALSE(differ(left, signature(steady(-9), rock))) << "farther away, on the same side";
}

TEST(WaySignature, LeavesOutWhatIsFarAway) {
  const std::vector<Obstacle> rock = {{"rock", 0, 50, 2, 2, 0, 0}};
  const auto left = signature(steady(-40), rock), right = signature(steady(40), rock);
  EXPECT_FALSE(differ(left, right, 30));
  EXPECT_TRUE(differ(left, right, 50));
}

TEST(WaySignature, TellsBeforeFromAfterWhatCrosses) {
  // Eastwards over the way at y = 50, on the way at t = 5.
  const std::vector<Obstacle> crossing = {{"crossing", -50, 50, 2, 2, 10, 0}};
  const auto before = way(0, 8, [](double t) { return 12.5 * t; });
  const auto after = way(0, 14, [](double t) { return t < 2 ? 0 : 100 * (t - 2) / 12; });
  EXPECT_TRUE(differ(signature(before, crossing), signature(after, crossing)));
  const auto sooner = way(0, 7, [](double t) { return 100 * t / 7; });
  EXPECT_FALSE(differ(signature(before, crossing), signature(sooner, crossing)));
}

TEST(WaySignature, TellsFollowingFromOvertaking) {
  const std::vector<Obstacle> slow = {{"slow", 0, 20, 2, 2, 0, 4}};
  const auto overtaken = signature(steady(6), slow);
  const auto followed = signature(way(0, 25, [](double t) { return 4 * t; }), slow);
  EXPECT_NEAR(followed[0].swept, 0, 1e-9);
  EXPECT_TRUE(differ(overtaken, followed));
}

TEST(WaySignature, TellsTheOrderOfPassings) {
  // Past the rock on its right, with the oncoming one on the right of it: before or after the rock.
  const std::vector<Obstacle> both = {{"rock", -6, 50, 2, 2, 0, 0},
                                      {"oncoming", 8, 150, 2, 2, 0, -10}};
  const auto first = steady(0);  // meets it at y = 75
  const auto last = way(0, 17, [](double t) { return t < 7 ? t : 7 + 9.3 * (t - 7); });  // at 50
  const auto waits = way(0, 22, [](double t) { return t < 12 ? t : 12 + 8.8 * (t - 12); });
  EXPECT_TRUE(differ(signature(first, both), signature(waits, both)));
  EXPECT_FALSE(differ(signature(last, both), signature(waits, both)))
      << "nearly beside each other: no order";
  EXPECT_FALSE(differ(signature(first, both), signature(first, both)));
}

TEST(WaySignature, OfNoPointsIsEmpty) {
  EXPECT_TRUE(signature({}, {{"rock", 0, 50, 2, 2, 0, 0}}).empty());
  EXPECT_FALSE(differ({}, {}));
}

}  // namespace
}  // namespace slalom::world
