#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/expect_plan.hpp"
#include "planner/scenes.hpp"
#include "planner/verified_scenes.hpp"

namespace slalom::planner {
namespace {

TEST(LocalFrame, MapCoordinatesGiveThePlanOfTheOrigin) {
  const double dx = 122 * 4096.0, dy = 1318 * 4096.0;  // 5.0e5, 5.4e6: as UTM has them
  for (const auto& scene : {E_B(), E_C()}) {
    const Scene there = moved(scene, dx, dy);
    const Plan plan = Planner(scene).plan(scene.first), far = Planner(there).plan(there.first);
    expect_solved(far);
    EXPECT_EQ(plan.report.iterations, far.report.iterations);
    EXPECT_LT(distance(plan, far,
                       [=](const State& s) {
                         return std::pair{s[vehicle::X] - dx, s[vehicle::Y] - dy};
                       }),
              1e-5);
  }
}

TEST(LocalFrame, WhatWasLookedAtLiesWhereThePlanDoes) {
  Task task = verified_task();
  const double dx = 5e5, dy = 5.4e6;
  task.goal.x += dx;
  task.goal.y += dy;
  for (auto& o : task.obstacles) {
    o.x += dx;
    o.y += dy;
  }
  Request request = northwards();
  request.X0p[vehicle::X] += dx;
  request.X0p[vehicle::Y] += dy;
  const Plan plan = Planner(task).plan(request);
  const auto drawn = std::find_if(plan.candidates.begin(), plan.candidates.end(),
                                  [](const auto& c) { return !c.path.empty(); });
  ASSERT_NE(drawn, plan.candidates.end());
  EXPECT_NEAR(drawn->path[0].x, dx, 1);
  EXPECT_NEAR(drawn->path[0].y, dy, 1);
}

TEST(LocalFrame, AnObstacleFarAwayChangesNothing) {
  const Scene scene = moved(E_B(), 5e5, 5.4e6);
  Scene with = scene;
  with.obstacles.push_back({"unused", 0, 0, 5, 5, 0, 0});
  with.obstacles.push_back({"flies by", 5e5, 6e6, 5, 5, 30, 0});
  auto planner = Planner(with);
  Request request = with.first;
  for (int cycle = 0; cycle < 3; ++cycle) {
    const Plan plan = planner.plan(request);
    expect_solved(plan);
    request = next_cycle(request, plan);
  }
  const Plan one = Planner(scene).plan(scene.first), other = Planner(with).plan(with.first);
  EXPECT_LT(distance(one, other, [](const State& s) { return std::pair{s[0], s[1]}; }), 0.05);
}

TEST(LocalFrame, AFarObstacleThatComesNearIsAvoided) {
  Scene scene = E_B();
  scene.obstacles.clear();
  // Where the vehicle is when it arrives, 8 s and many kilometres from where it is at first.
  scene.obstacles.push_back({"fast", 200, 60 + 1000 * 3.0, 5, 5, 0, -1000});
  auto planner = Planner(scene);
  const Plan plan = planner.plan(scene.first);
  EXPECT_GE(least_obstacle_row(scene, plan), -1e-6);
}

TEST(LocalFrame, HeadingsThatDifferByWholeTurnsAreOne) {
  for (const int turns : {-3, -1, 1, 2}) {
    const double more = 2 * std::numbers::pi * turns;
    Scene scene = E_B();
    Scene turned = scene;
    turned.first.X0p[vehicle::PSI] += more;
    turned.goal.psi -= more;
    const Plan one = Planner(scene).plan(scene.first), other = Planner(turned).plan(turned.first);
    expect_solved(other);
    EXPECT_LT(distance(one, other, [](const State& s) { return std::pair{s[0], s[1]}; }), 1e-6);
    for (std::size_t k = 0; k < one.states.size(); ++k)
      EXPECT_NEAR(other.states[k][vehicle::PSI] - more, one.states[k][vehicle::PSI], 1e-9);
  }
}

TEST(LocalFrame, APlanMayTurnPastTheHeadingAtWhichTurnsBegin) {
  Scene scene = E_B();
  scene.obstacles.clear();
  scene.goal = {.x = 100, .y = 60, .psi = std::numbers::pi, .sigma = 8};
  scene.first.X0p = {200, 8.5, 0, 0, 3.05, 0, 10, 0};
  scene.planner.w_psi = 1;  // asks for the goal's heading, whichever turn it is given in
  auto planner = Planner(scene);
  Request request = scene.first;
  for (int cycle = 0; cycle < 8; ++cycle) {
    request.X0p[vehicle::PSI] = (cycle % 2 == 0 ? 3.1 : 3.2);  // to either side of it
    const Plan plan = planner.plan(request);
    expect_solved(plan);
    EXPECT_LT(std::fabs(plan.states.back()[vehicle::PSI] - request.X0p[vehicle::PSI]), 3);
    request = next_cycle(request, plan);
  }
}

}  // namespace
}  // namespace slalom::planner
