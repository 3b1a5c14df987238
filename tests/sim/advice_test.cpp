#include "slalom/sim/advice.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "sim/fakes.hpp"

namespace slalom::sim {
namespace {

using testing::circle;

Scenario field() {
  auto s = testing::open_field();
  s.goal = {0, 150, std::numbers::pi / 2, 10};
  s.loop.timeout = 30;
  return s;
}

std::string all(const Scenario& s) {
  std::string text;
  for (const auto& sentence : advice(s)) text += sentence + "\n";
  return text;
}

bool says(const Scenario& s, const std::string& part) {
  return all(s).find(part) != std::string::npos;
}

TEST(Advice, NothingForWhatIsWell) {
  EXPECT_EQ(all(field()), "");
}

TEST(Advice, ObstaclesThatPassBetweenTwoNodes) {
  auto s = field();
  s.obstacles = {circle("lorry", 20, 140, 1, 0, -30)};
  EXPECT_TRUE(says(s, "lorry and the vehicle come")) << all(s);
  auto finer = s;
  finer.planner.N = 40;
  EXPECT_FALSE(says(finer, "lorry"));
  finer = s;
  finer.planner.between_nodes = planner::BetweenNodes::refine;
  EXPECT_FALSE(says(finer, "lorry"));
  s.obstacles[0].a = s.obstacles[0].b = 10;
  EXPECT_FALSE(says(s, "lorry"));
}

TEST(Advice, WhatIsHitBeforeTheFirstPlan) {
  auto s = field();
  const double speed = s.start[vehicle::UX];
  s.obstacles = {circle("pole", 0, 0.6 * speed + 3, 1)};  // grown by 2 m, hit at .6 s
  s.loop.tex = 0.5;
  EXPECT_FALSE(says(s, "before the first plan")) << all(s);
  s.loop.tex = 0.7;
  EXPECT_TRUE(says(s, "begins, at 0.7 s, the vehicle goes straight on and hits pole at 0.6"))
      << all(s);
  s.loop.latency = LatencyRule::instant;
  EXPECT_FALSE(says(s, "before the first plan")) << all(s);
}

TEST(Advice, AGoalBehindTheVehicle) {
  auto s = field();
  s.goal = {80, -10, 0, 10};
  EXPECT_TRUE(says(s, "97 degrees off the vehicle's heading")) << all(s);
  EXPECT_EQ(advice_at_start(s).size(), 1u);
  s.goal.y = 10;
  EXPECT_FALSE(says(s, "off the vehicle's heading"));
  EXPECT_TRUE(advice_at_start(s).empty());
  s.goal = {80, -10, 0, 10};
  s.start[vehicle::PSI] -= 4 * std::numbers::pi + 0.2;
  EXPECT_FALSE(says(s, "off the vehicle's heading"));
}

TEST(Advice, GapsThatAreTooNarrow) {
  auto s = field();
  s.obstacles = {circle("left", -5, 60, 3), circle("right", 4.5, 60, 3)};  // 3.5 m apart
  EXPECT_TRUE(says(s, "twice the margin of 2.5 m (the narrowest: left and right, 3.50 m)"))
      << all(s);
  s.obstacles[1].x = 6.1;
  EXPECT_FALSE(says(s, "gap"));
}

TEST(Advice, AGapThatSomethingFillsIsNone) {
  auto s = field();
  s.loop.timeout = 1;  // of the search for a way, which is not what is asked
  s.obstacles = {circle("wall1", -2, 60, 2), circle("wall2", 2, 60, 2), circle("wall3", 6, 60, 2)};
  EXPECT_FALSE(says(s, "narrower")) << all(s);  // wall1 and wall3 are 4 m apart
  s.obstacles[1].y += 2.5;                      // beside the way between them
  EXPECT_TRUE(says(s, "3 gaps between")) << all(s);
  s.obstacles[1] = circle("wall2", 2, 60, 0.5);  // in it: two gaps of 1.5 m
  EXPECT_TRUE(says(s, "2 gaps between")) << all(s);
  EXPECT_TRUE(says(s, "the narrowest: wall1 and wall2, 1.50 m")) << all(s);
  s.obstacles[1].vx = 3;  // drives out of it
  EXPECT_TRUE(says(s, "a gap between")) << all(s);
  // One beyond another on one line is between nothing.
  s.obstacles = {circle("wall1", -2, 60, 2), circle("wall2", 4.5, 60, 2),
                 circle("post", 15, 60, 1)};
  EXPECT_TRUE(says(s, "a gap between")) << all(s);
}

/// Of two boxes that come together at one end, what stands where they are far apart fills nothing.
TEST(Advice, AGapIsWhereItIsNarrowest) {
  auto s = field();
  s.loop.timeout = 1;  // of the search for a way, which is not what is asked
  const auto box = [](const char* name, double x, double psi) {
    const auto shape = world::Polygon::rectangle(30, 2);
    world::Obstacle o{name, x, 60, shape.reach(), shape.reach()};
    o.outline = std::make_shared<world::Polygon>(shape);
    o.psi = psi;
    return o;
  };
  const double lean = 0.3, up = std::numbers::pi / 2;
  s.obstacles = {box("left", -7.5, up - lean), box("right", 7.5, up + lean)};
  const double gap = world::distance(s.obstacles[0], s.obstacles[1].corners_at(0), 0);
  ASSERT_GT(gap, 3);
  ASSERT_LT(gap, 5);
  s.obstacles.push_back(circle("post", 0, 60, 0.5));
  EXPECT_TRUE(says(s, "the narrowest: left and right")) << all(s);
  s.obstacles[2].y = 60 + 15 * std::cos(lean);
  EXPECT_FALSE(says(s, "left and right")) << all(s);
}

TEST(Advice, GapsBetweenBoxesThatABodyDoesNotFit) {
  auto s = field();
  const auto box = [](const char* name, double x) {
    const auto shape = world::Polygon::rectangle(6, 2);
    world::Obstacle o{name, x, 60, shape.reach(), shape.reach()};
    o.outline = std::make_shared<world::Polygon>(shape);
    o.psi = 0.3;
    return o;
  };
  s.planner.sm_start = s.planner.sm_end = 0.5;
  s.obstacles = {box("left", 0), box("right", 10)};
  const double gap = world::distance(s.obstacles[0], s.obstacles[1].corners_at(0), 0);
  EXPECT_GT(gap, 3);
  EXPECT_FALSE(says(s, "narrower")) << all(s);
  s.obstacles[1].x -= gap - 2.5;  // and the rest of it at an angle
  EXPECT_FALSE(says(s, "narrower")) << all(s);
  s.vehicle.footprint = vehicle::FootprintKind::rectangle;
  EXPECT_TRUE(says(s,
                   "twice the margin of 0.5 m and the vehicle's 2 m (the narrowest: left and "
                   "right"))
      << all(s);
}

TEST(Advice, AGoalWithoutAWay) {
  auto s = field();
  s.region = {-10, 10, -20, 300};
  s.obstacles = {circle("left", -6, 60, 5), circle("right", 6, 60, 5)};
  EXPECT_TRUE(says(s, "no way from start to goal")) << all(s);
}

// Of a vehicle with a body the margins are beside it, not beside its middle.
TEST(Advice, AWayThatTheBodyFitsIsOne) {
  auto s = field();
  s.vehicle.footprint = vehicle::FootprintKind::rectangle;  // 2 m wide
  s.planner.sm_start = s.planner.sm_end = 0.5;
  s.region = {-10, 10, -20, 300};
  s.obstacles = {circle("left", -7, 60, 5), circle("right", 7, 60, 5)};  // 4 m apart
  EXPECT_EQ(all(s), "");
  s.obstacles[1].x = 6;
  EXPECT_TRUE(says(s, "no way from start to goal was found that keeps 0.5 m")) << all(s);
}

TEST(Advice, LoadsThatAreNotTheWeight) {
  auto s = field();
  s.vehicle.m = 1350;
  EXPECT_TRUE(says(s, "are not the weight m g = 13239 N")) << all(s);
}

}  // namespace
}  // namespace slalom::sim
