// Which obstacles a plan knows of.

#include "../../src/planner/obstacle_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planner/expect_plan.hpp"
#include "planner/scenes.hpp"

namespace slalom::planner {
namespace {

std::vector<std::string> names(const std::vector<world::Obstacle>& obstacles) {
  std::vector<std::string> names;
  for (const auto& o : obstacles) names.push_back(o.name);
  return names;
}
using Names = std::vector<std::string>;

Settings choosing(ObstacleChoice choice, int count = 5) {
  Settings s;
  s.obstacle_choice = choice;
  s.obstacle_count = count;
  return s;
}

const world::Footprint kPoint{vehicle::Parameters{}};
const std::vector<world::Obstacle> kRow = {{"a", 0, 20, 2, 2, 0, 0},
                                           {"b", 0, 300, 2, 2, 0, -30},
                                           {"c", 0, 64, 2, 2, 0, 0},
                                           {"d", 0, 9, 1, 1, 0, 0}};

TEST(ObstacleChoice, InReachDropsOnlyWhatNoPlanCanTouch) {
  // From (0, 0) a plan reaches 50 + 5 m and the slacks; "c" begins 64 - 2 - 4 = 58 m away.
  const Request request;
  auto s = choosing(ObstacleChoice::in_reach);
  EXPECT_EQ(names(choose_obstacles(s, request, kRow, kPoint)), (Names{"a", "b", "d"})) << "b comes";
  s.moving_avoidance = false;
  EXPECT_EQ(names(choose_obstacles(s, request, kRow, kPoint)), (Names{"a", "d"})) << "b is held";
  s.sm_end = 9;
  EXPECT_EQ(names(choose_obstacles(s, request, kRow, kPoint)), (Names{"a", "c", "d"}));
}

TEST(ObstacleChoice, NearestCountsFromTheEdgeAtTheStartOfThePlanAndKeepsTheOrder) {
  Request request;
  EXPECT_EQ(names(choose_obstacles(choosing(ObstacleChoice::nearest, 2), request, kRow, kPoint)),
            (Names{"a", "d"}));
  request.t0 = 9;
  request.t_start = 9.5;  // b stands at 300 - 30 * 9.5 = 15
  EXPECT_EQ(names(choose_obstacles(choosing(ObstacleChoice::nearest, 2), request, kRow, kPoint)),
            (Names{"b", "d"}));
  EXPECT_EQ(choose_obstacles(choosing(ObstacleChoice::nearest, 9), request, kRow, kPoint).size(),
            4u);
  const std::vector<world::Obstacle> long_one = {{"far", 0, 10, 1, 1, 0, 0},
                                                 {"long", 40, 0, 38, 1, 0, 0}};
  EXPECT_EQ(
      names(choose_obstacles(choosing(ObstacleChoice::nearest, 1), request, long_one, kPoint)),
      (Names{"long"}));
}

TEST(Groups, ChainsOfOneVelocityBecomeOneEllipse) {
  Settings s;
  const auto scene = E_C();
  EXPECT_EQ(names(group_obstacles(s, scene.obstacles)), names(scene.obstacles)) << "off";
  s.obstacle_group_gap = 4.2;
  EXPECT_EQ(group_obstacles(s, scene.obstacles).size(), 38u) << "cones stand 4.225 m apart";
  s.obstacle_group_gap = 4.3;
  const auto groups = group_obstacles(s, scene.obstacles);
  EXPECT_EQ(names(groups), (Names{"O1", "O2", "cone1+35"}));
  EXPECT_DOUBLE_EQ(groups[2].y, 87.5);
  std::vector<world::Obstacle> moving = {
      {"p", 0, 0, 1, 1, 0, 5}, {"q", 0, 3, 1, 1, 0, 5}, {"r", 0, 6, 1, 1, 0, 0}};
  const auto two = group_obstacles(s, moving);
  ASSERT_EQ(names(two), (Names{"p+1", "r"}));
  EXPECT_EQ(two[0].vy, 5);
}

TEST(Groups, HaveOneMargin) {
  Settings s;
  s.obstacle_group_gap = 4;
  std::vector<world::Obstacle> row = {{"p", 0, 0}, {"q", 0, 3}, {"r", 0, 6}, {"s", 0, 9}};
  row[1].margin_start = row[2].margin_start = 0.5;
  row[2].margin_rate = 0.3;
  EXPECT_EQ(names(group_obstacles(s, row)), (Names{"p", "q", "r", "s"}));
  row[1].margin_rate = 0.3;
  const auto groups = group_obstacles(s, row);
  ASSERT_EQ(names(groups), (Names{"p", "q+1", "s"}));
  EXPECT_DOUBLE_EQ(groups[1].margin(2), 1.1);
}

TEST(Groups, TheEllipseCoversItsMembersAndLittleElse) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-20, 20), size(0.2, 6);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<world::Obstacle> members;
    for (int k = 0; k < 2 + trial % 5; ++k)
      members.push_back({"m", place(random), place(random), size(random), size(random), 0, 0});
    const world::Obstacle cover = covering_ellipse(members);
    double most = 0;
    for (const auto& m : members)
      for (int k = 0; k < 5000; ++k) {
        const double angle = 2 * std::numbers::pi * k / 5000;
        most = std::max(most, std::hypot((m.x + m.a * std::cos(angle) - cover.x) / cover.a,
                                         (m.y + m.b * std::sin(angle) - cover.y) / cover.b));
      }
    EXPECT_LE(most, 1);
    EXPECT_GT(most, 0.98);
  }
}

TEST(ObstacleChoice, AChosenProblemHasTheChosenRowsAndPlansGoOnAsTheChoiceChanges) {
  for (const auto choice : {ObstacleChoice::in_reach, ObstacleChoice::nearest}) {
    Scene scene = E_C();
    scene.planner.obstacle_choice = choice;
    scene.planner.obstacle_count = 12;
    auto planner = Planner(scene);
    Request request = scene.first;
    for (int cycle = 0; cycle < 8; ++cycle) {
      const Plan plan = planner.plan(request);
      ASSERT_TRUE(plan.report.solved) << cycle << ": " << plan.report.status_text();
      if (choice == ObstacleChoice::in_reach) EXPECT_GE(least_obstacle_row(scene, plan), -1e-6);
      request = next_cycle(request, plan);
    }
  }
}

/// What cannot be touched does not move the plan but through the barrier's far tail.
TEST(ObstacleChoice, InReachPlansAsAllDo) {
  Scene scene = E_C();
  const Plan all = Planner(scene).plan(scene.first);
  scene.planner.obstacle_choice = ObstacleChoice::in_reach;
  const Plan some = Planner(scene).plan(scene.first);
  EXPECT_LT(distance(all, some, [](const State& x) { return std::pair(x[0], x[1]); }), 0.1);
}

/// The list changes in a cycle without a plan, after which the next starts from the plan before it:
/// that one's multipliers are not those of the list's rows.
TEST(ObstacleChoice, APlanAfterOneThatFailedStartsFromWhatBelongsToTheLastOne) {
  for (const auto choice : {ObstacleChoice::in_reach, ObstacleChoice::nearest}) {
    Scene scene = E_B();
    scene.planner.obstacle_choice = choice;
    scene.planner.obstacle_count = 2;
    const auto& o = scene.obstacles;
    const world::Obstacle far{"far", 1000, 0, 1, 1, 0, 0};  // out of reach
    Request first = scene.first;
    first.obstacles = {{o[0], o[1], far}};
    Planner failing(scene), fresh(scene);
    const Plan plan = failing.plan(first);
    ASSERT_TRUE(plan.report.solved);
    expect_same(fresh.plan(first), plan);

    Request second = next_cycle(first, plan), third = second;
    const double x = second.X0p[0], y = second.X0p[1];
    third.obstacles = {{o[0], o[2], {"O4", x + 25, y, 1, 1, 0, 0}, far}};
    if (choice == ObstacleChoice::nearest) third.obstacles->erase(third.obstacles->begin());
    second.obstacles = third.obstacles;
    for (auto& each : *second.obstacles)  // all upon the vehicle, and too large for any way out
      if (each.name != "far") each = {each.name, x, y, 60, 60, 0, 0};
    ASSERT_FALSE(failing.plan(second).report.solved);
    const Plan after = failing.plan(third);
    EXPECT_TRUE(after.report.solved) << after.report.status_text();
    expect_same(fresh.plan(third), after);
  }
}

TEST(ObstacleChoice, ASolveIsReplayedWithTheObstaclesItHad) {
  Scene scene = E_C();
  scene.planner.obstacle_choice = ObstacleChoice::nearest;
  auto planner = Planner(scene);
  std::vector<Recording> recordings;
  planner.record({[](const SolveReport&) { return true; },
                  [&](const Recording& r) { recordings.push_back(r); }});
  Request request = scene.first;
  for (int cycle = 0; cycle < 3; ++cycle) request = next_cycle(request, planner.plan(request));
  for (const auto& r : recordings) EXPECT_TRUE(replay(r, scene).same);
}

}  // namespace
}  // namespace slalom::planner
