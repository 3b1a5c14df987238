// Drives that leave their road.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "sim/fakes.hpp"
#include "slalom/base/error.hpp"
#include "slalom/sim/closed_loop.hpp"
#include "slalom/sim/watch.hpp"

namespace slalom::sim {
namespace {

using vehicle::State;

/// Northwards for 50 m, and then to the left along a bend of radius 40 m.
std::shared_ptr<const world::Road> bend() {
  std::vector<world::RoadPoint> line;
  for (double y = -20; y <= 50; y += 5) line.push_back({0, y, 4, 4});
  for (double angle = 0.125; angle < 1.6; angle += 0.125)
    line.push_back({-40 + 40 * std::cos(angle), 50 + 40 * std::sin(angle), 4, 4});
  return std::make_shared<world::Road>(line, false, std::vector<std::vector<world::Point>>{},
                                       "bend");
}

Criteria on_bend(bool body) {
  Criteria criteria;
  criteria.goal.y = 1000;
  criteria.road = bend();
  auto car = testing::open_field().vehicle;
  if (body) car.footprint = vehicle::FootprintKind::rectangle;
  criteria.footprint = world::Footprint(car);
  return criteria;
}

/// Straight on northwards at 17 m/s from the origin.
std::optional<Event> straight_on(const Criteria& criteria) {
  static const vehicle::Plant plant(testing::open_field().vehicle, 1e-9, 0.02);
  const vehicle::ControlSignal signal;
  Watch watch(criteria, plant.dynamics());
  State state = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};
  double t = 0;
  watch.begin(t, state);
  for (const double t1 : plant.instants(signal, 0, 6)) {
    const auto stretch = Stretch::driven(plant, signal, state, t, t1);
    if (auto event = watch.pass(stretch)) return event;
    state = stretch.state1;
    t = t1;
  }
  return std::nullopt;
}

TEST(OffRoad, ThePointIsLocatedWhereItLeaves) {
  const auto event = straight_on(on_bend(false));
  ASSERT_TRUE(event);
  EXPECT_EQ(event->outcome, Outcome::off_road);
  // It leaves the outer edge, of radius 44 m about (-40, 50), at x = 0.
  EXPECT_NEAR(event->t, (50 + std::sqrt(44 * 44 - 40 * 40)) / 17, 2e-3);
  // Just before it is on the road, and then off.
  const auto road = bend();
  EXPECT_GT(road->edge_distance(world::Point{0, 17 * (event->t - 1e-6)}), 0);
  EXPECT_LT(road->edge_distance(world::Point{0, 17 * (event->t + 1e-6)}), 0);
}

TEST(OffRoad, TheBodyLeavesWithItsFirstCorner) {
  const Criteria criteria = on_bend(true);
  const auto event = straight_on(criteria);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->outcome, Outcome::off_road);
  const auto& corners = criteria.footprint.corners();
  const double front = corners[0].x, half = corners[0].y;
  const double outer = 50 + std::sqrt(44 * 44 - (40 + half) * (40 + half)) - front;
  EXPECT_NEAR(event->t, outer / 17, 5e-3);
}

/// Straight on from the origin, along the bend's beginning, to a goal of the road.
Drive driven_to(const world::Goal& goal) {
  Scenario scenario = testing::open_field();
  scenario.road = bend();
  scenario.goal = world::placed(goal, scenario.road.get());
  scenario.start = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};
  return sim::drive(scenario, testing::straight_on);
}

TEST(OffRoad, ADriveEndsThere) {
  world::Goal goal;
  goal.s = 110;
  const Drive drive = driven_to(goal);
  EXPECT_EQ(drive.outcome, Outcome::off_road);
  EXPECT_NEAR(drive.time, (50 + std::sqrt(44 * 44 - 40 * 40)) / 17, 2e-3);
  EXPECT_NE(drive.message.find("left the road"), std::string::npos);
  EXPECT_NEAR(drive.least_edge_distance, 0, 1e-6);
  EXPECT_GT(drive.progress, 60);
}

TEST(OffRoad, AGoalByTimeEndsTheDriveWhenItIsUp) {
  world::Goal goal;
  goal.time = 2.3;
  const Drive drive = driven_to(goal);
  EXPECT_EQ(drive.outcome, Outcome::goal);
  EXPECT_NEAR(drive.time, 2.3, 1e-9);
  EXPECT_NEAR(drive.progress, 17 * 2.3, 1e-3);
}

TEST(OffRoad, ADriveWhoseTimeIsUpEndsAlsoWhereMoreIsAsked) {
  world::Goal goal;
  goal.time = 2.3;
  goal.ux_max = 5;
  const Drive drive = driven_to(goal);
  EXPECT_EQ(drive.outcome, Outcome::timeout);
  EXPECT_NEAR(drive.time, 2.3, 1e-9);
  EXPECT_NE(drive.message.find("not as the goal asks"), std::string::npos) << drive.message;
}

std::string refusal(const Scenario& scenario) {
  try {
    check(scenario, "file");
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "";
}

TEST(OffRoad, ALineMustLieAhead) {
  Scenario scenario = testing::open_field();
  scenario.road = bend();
  scenario.start = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};  // 20 m along the road
  scenario.goal.s = 15;
  EXPECT_NE(refusal(scenario).find("a line ahead of the start"), std::string::npos)
      << refusal(scenario);
  scenario.goal.s = 25;
  EXPECT_EQ(refusal(scenario), "");
  std::vector<world::RoadPoint> ring;
  for (double angle = 0; angle < 6.2; angle += 0.2)
    ring.push_back({-80 + 80 * std::cos(angle), 80 * std::sin(angle), 4, 4});
  scenario.road =
      std::make_shared<world::Road>(ring, true, std::vector<std::vector<world::Point>>{}, "ring");
  scenario.goal.s = 0.7 * scenario.road->length();
  EXPECT_NE(refusal(scenario).find("less than half a lap ahead"), std::string::npos)
      << refusal(scenario);
  scenario.goal.s = 0.3 * scenario.road->length();
  EXPECT_EQ(refusal(scenario), "");
}

TEST(OffRoad, StartGoalAndVehicleMustBeOnTheRoad) {
  Scenario scenario = testing::open_field();
  scenario.road = bend();
  scenario.goal = {.x = 0, .y = 40, .sigma = 5};
  scenario.start = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};
  EXPECT_EQ(refusal(scenario), "");
  auto off = scenario;
  off.start[vehicle::X] = 4.5;
  EXPECT_NE(refusal(off).find("start"), std::string::npos);
  EXPECT_NE(refusal(off).find("0.5 m off the road"), std::string::npos);
  off = scenario;
  off.goal.x = -5;
  EXPECT_NE(refusal(off).find("goal"), std::string::npos);
  off = scenario;
  off.road = std::make_shared<world::Road>(
      std::vector<world::RoadPoint>{{0, -20, 1, 1}, {0, 50, 1, 1}, {0, 90, 1, 1}}, false,
      std::vector<std::vector<world::Point>>{}, "narrow");
  EXPECT_EQ(refusal(off), "");
  off.vehicle.footprint = vehicle::FootprintKind::rectangle;
  EXPECT_NE(refusal(off).find("width"), std::string::npos);
  off = scenario;
  off.goal.y = -15;
  EXPECT_NE(refusal(off).find("15 m behind the start along the road"), std::string::npos)
      << refusal(off);
  off.planner.method = planner::Method::verified;
  EXPECT_EQ(refusal(off), "");
  off = scenario;
  off.goal = {};
  off.goal.laps = 1;
  EXPECT_NE(refusal(off).find("closed road"), std::string::npos);
}

}  // namespace
}  // namespace slalom::sim
