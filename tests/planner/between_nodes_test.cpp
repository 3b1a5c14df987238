// Plans that keep off obstacles at their nodes and go through them between.

#include <gtest/gtest.h>

#include <cmath>

#include "planner/expect_plan.hpp"
#include "planner/scenes.hpp"

namespace slalom::planner {
namespace {

/// Comes at the vehicle at 50 m/s together, with ground on both sides.
Scene wrong_way() {
  Scene scene;
  scene.planner.L_range = 90;
  scene.planner.kappa = 10;
  scene.vehicle.ux_max = 25;
  scene.goal = {.x = 300, .y = 0, .psi = 0, .sigma = 5};
  scene.obstacles = {{"lorry", 200, 0, 2.3, 0.9, -30, 0}};
  scene.first = {{42, 0, 0, 0, 0, 0, 20, 0}, 1.5, 2};
  return scene;
}

/// How deep the plan goes into the margin, by its controls on the reference model, at many moments.
double deepest_driven(const Scene& scene, const Plan& plan) {
  const double margin = std::min(scene.planner.sm_start, scene.planner.sm_end);
  double most = 0;
  for (double t = 0.02; t <= plan.tf; t += 0.02) {
    const State x = integrate(plan, t);
    for (const auto& o : scene.obstacles)
      most = std::max(most, margin - world::distance(o, x[0], x[1], plan.t_start + t));
  }
  return most;
}

TEST(BetweenNodes, APlanThroughAnObstacleSaysSoAndIsDriven) {
  const Scene scene = wrong_way();
  const Plan plan = Planner(scene).plan(scene.first);
  EXPECT_TRUE(plan.report.solved);
  EXPECT_EQ(plan.report.status, PlanStatus::passes_through) << plan.report.status_text();
  EXPECT_EQ(plan.report.passage.obstacle, "lorry");
  EXPECT_NEAR(plan.report.passage.depth, deepest_driven(scene, plan), 0.1);
  EXPECT_NE(plan.report.status_text().find("of lorry at"), std::string::npos);
}

TEST(BetweenNodes, RefinedItKeepsOff) {
  Scene scene = wrong_way();
  scene.planner.between_nodes = BetweenNodes::refine;
  auto planner = Planner(scene);
  Request request = scene.first;
  for (int cycle = 0; cycle < 3; ++cycle) {
    const Plan plan = planner.plan(request);
    expect_solved(plan);
    EXPECT_LT(deepest_driven(scene, plan), scene.planner.passage_depth + 0.1);
    request = next_cycle(request, plan);
  }
}

TEST(BetweenNodes, IgnoredItIsAsItWas) {
  Scene scene = wrong_way();
  const Plan reported = Planner(scene).plan(scene.first);
  scene.planner.between_nodes = BetweenNodes::ignore;
  const Plan plan = Planner(scene).plan(scene.first);
  EXPECT_EQ(plan.report.status, PlanStatus::solved);
  EXPECT_EQ(plan.report.passage.depth, 0);
  expect_same(plan, reported);
}

TEST(BetweenNodes, PlansThatKeepOffSayNothing) {
  for (const auto& scene : {E_A(), E_B(), E_C()}) {
    const Plan plan = Planner(scene).plan(scene.first);
    EXPECT_EQ(plan.report.status, PlanStatus::solved) << plan.report.status_text();
    EXPECT_LE(plan.report.passage.depth, scene.planner.passage_depth);
  }
}

TEST(RetrySides, AnOptionThatFindsAWayWhereOneSideFails) {
  int rescued = 0, lost = 0;
  for (int N = 8; N <= 20; ++N) {
    Scene scene = E_B();
    scene.planner.N = N;
    scene.obstacles = {{"wall", 202, 45, 14, 2, 0, 0}};
    const bool before = Planner(scene).plan(scene.first).report.solved;
    scene.planner.retry_sides = true;
    const bool after = Planner(scene).plan(scene.first).report.solved;
    rescued += after && !before;
    lost += before && !after;
  }
  EXPECT_EQ(lost, 0);
  EXPECT_GT(rescued, 0);
}

}  // namespace
}  // namespace slalom::planner
