#include "slalom/world/goal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slalom/base/error.hpp"

namespace slalom::world {
namespace {

using vehicle::State;
constexpr double kPi = std::numbers::pi;

State at(double x, double y, double psi = 0, double ux = 10) {
  State state{};
  state[vehicle::X] = x;
  state[vehicle::Y] = y;
  state[vehicle::PSI] = psi;
  state[vehicle::UX] = ux;
  return state;
}

Road straight(bool closed = false) {
  if (!closed) return Road({{0, 0, 3, 3}, {50, 0, 3, 3}, {100, 0, 3, 3}}, false, {}, "road");
  std::vector<RoadPoint> ring;
  for (int k = 0; k < 36; ++k)
    ring.push_back({30 * std::cos(k * kPi / 18), 30 * std::sin(k * kPi / 18), 3, 3});
  return Road(ring, true, {}, "ring");
}

TEST(Goal, TheSquareIsReachedUpToItsSides) {
  const Goal goal{.x = 10, .y = 20, .sigma = 5};
  EXPECT_EQ(goal.kind(), GoalKind::square);
  EXPECT_TRUE(goal.reached(at(15, 15), 0, nullptr));
  EXPECT_FALSE(goal.reached(at(std::nextafter(15, 16), 20), 0, nullptr));
  EXPECT_EQ(goal.outside(at(18, 21), 0, nullptr), 3);
}

TEST(Goal, ARectangleIsTurned) {
  const Goal goal{.x = 10, .y = 0, .psi = kPi / 4, .length = 10, .width = 2};
  EXPECT_TRUE(goal.reached(at(13, 3), 0, nullptr));
  EXPECT_FALSE(goal.reached(at(13, -3), 0, nullptr));
  EXPECT_NEAR(goal.outside(at(10 + 6 / std::sqrt(2), 6 / std::sqrt(2)), 0, nullptr), 1, 1e-12);
}

TEST(Goal, AsksForHeadingSpeedAndTimeWhereTheyAreStated) {
  Goal goal{.x = 0, .y = 0, .psi = kPi, .length = 4, .width = 4};
  goal.psi_tolerance = 0.1;
  EXPECT_TRUE(goal.reached(at(0, 0, -kPi + 0.05), 3, nullptr));  // whole turns do not count
  EXPECT_FALSE(goal.reached(at(0, 0, kPi - 0.2), 3, nullptr));
  goal.ux_min = 2;
  goal.ux_max = 8;
  EXPECT_TRUE(goal.reached(at(0, 0, kPi, 8), 3, nullptr));
  EXPECT_FALSE(goal.reached(at(0, 0, kPi, 8.1), 3, nullptr));
  EXPECT_FALSE(goal.reached(at(0, 0, kPi, 1.9), 3, nullptr));
  goal.t_min = 5;
  goal.t_max = 6;
  EXPECT_FALSE(goal.reached(at(0, 0, kPi, 8), 3, nullptr));
  EXPECT_TRUE(goal.reached(at(0, 0, kPi, 8), 5, nullptr));
  EXPECT_FALSE(goal.reached(at(0, 0, kPi, 8), 6.5, nullptr));
}

TEST(Goal, ALineIsReachedAlongTheRoad) {
  Goal goal;
  goal.s = 60;
  const Road road = straight();
  EXPECT_NEAR(goal.outside(at(50, 2), 0, &road), 10, 1e-9);
  EXPECT_TRUE(goal.reached(at(60.001, -2), 0, &road));
  const Goal placed = world::placed(goal, &road);
  EXPECT_NEAR(placed.x, 60, 1e-9);
  EXPECT_NEAR(placed.psi, 0, 1e-9);
}

TEST(Goal, OnAClosedRoadTheHalfLapAfterALineIsBeyondIt) {
  Goal goal;
  const Road ring = straight(true);
  goal.s = ring.length() / 4;
  EXPECT_FALSE(goal.reached(at(30, 1), 0, &ring));
  EXPECT_TRUE(goal.reached(at(-30, 1), 0, &ring));
  EXPECT_FALSE(goal.reached(at(1, -30), 0, &ring));
}

TEST(Goal, ATimeIsReachedWhenItIsUp) {
  Goal goal;
  goal.time = 7;
  const Road road = straight();
  EXPECT_FALSE(goal.reached(at(0, 0), 6.99, &road));
  EXPECT_TRUE(goal.reached(at(0, 0), 7, &road));
}

std::string refusal(const Goal& goal, const Road* road) {
  try {
    check(goal, road, "goal");
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "";
}

TEST(Goal, RefusesWhatNoVehicleCanReach) {
  const Road road = straight(), ring = straight(true);
  Goal line, time, laps, box, speed;
  line.s = 101;
  time.time = 5;
  laps.laps = 1.5;
  box.length = 5;
  speed.ux_min = 5;
  speed.ux_max = 4;
  EXPECT_NE(refusal(line, &road).find("at most 100"), std::string::npos);
  EXPECT_NE(refusal(time, nullptr).find("without a road"), std::string::npos);
  EXPECT_EQ(refusal(time, &road), "");
  EXPECT_NE(refusal(laps, &ring).find("whole number"), std::string::npos);
  laps.laps = 1;
  EXPECT_NE(refusal(laps, &road).find("closed"), std::string::npos);
  EXPECT_EQ(refusal(laps, &ring), "");
  laps.ux_max = 5;
  EXPECT_NE(refusal(laps, &ring).find("ux_max beside laps"), std::string::npos);
  Goal turned = time;
  turned.psi_tolerance = 0.1;
  EXPECT_NE(refusal(turned, &ring).find("psi_tolerance beside time"), std::string::npos);
  line.s = 50;
  line.time = 5;
  EXPECT_NE(refusal(line, &road).find("both s and time"), std::string::npos);
  time.t_min = 6;
  EXPECT_NE(refusal(time, &road).find("from t_min to t_max"), std::string::npos);
  EXPECT_NE(refusal(box, nullptr).find("both"), std::string::npos);
  EXPECT_NE(refusal(speed, nullptr).find("ux_min <= ux_max"), std::string::npos);
  EXPECT_NE(refusal({.x = INFINITY}, nullptr).find("finite"), std::string::npos);
}

}  // namespace
}  // namespace slalom::world
