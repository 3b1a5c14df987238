// Plans that keep off obstacles and on their road at their nodes, and do not between.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "../../src/planner/between_nodes.hpp"
#include "planner/edge_distance.hpp"
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

TEST(BetweenNodes, ASoftPlanThroughAnObstacleSaysSoAndIsDriven) {
  Scene scene = wrong_way();
  scene.planner.obstacle_constraint = ObstacleConstraint::soft;
  const Plan plan = Planner(scene).plan(scene.first);
  EXPECT_TRUE(plan.report.solved);
  EXPECT_EQ(plan.report.status, PlanStatus::passes_through) << plan.report.status_text();
  EXPECT_NEAR(plan.report.passage.depth, deepest_driven(scene, plan), 0.1);
  EXPECT_GT(plan.report.passage.unseen(), scene.planner.passage_depth) << "its nodes are beside it";
  scene.planner.between_nodes = BetweenNodes::refine;
  const Plan refined = Planner(scene).plan(scene.first);
  EXPECT_GT(refined.t.size(), plan.t.size());
  EXPECT_TRUE(refined.report.solved);
  EXPECT_LT(deepest_driven(scene, refined), scene.planner.passage_depth + 0.1);
}

/// What stands in the way, and costs next to nothing.
Scene cheap_to_enter() {
  Scene scene = E_B();
  scene.planner.obstacle_constraint = ObstacleConstraint::soft;
  scene.planner.w_obstacle = 0.01;
  scene.obstacles = {{"hedge", 200.5, 40, 5, 5, 0, 0}};
  return scene;
}

TEST(BetweenNodes, WhatSoftRowsLetInAtNodesIsSaidAndIsNoReasonForFinerMeshes) {
  Scene scene = cheap_to_enter();
  const Plan reported = Planner(scene).plan(scene.first);
  const Passage& passage = reported.report.passage;
  EXPECT_EQ(reported.report.status, PlanStatus::passes_through) << reported.report.status_text();
  EXPECT_TRUE(reported.report.solved);
  EXPECT_GT(passage.at_nodes, scene.planner.sm_start) << "into the obstacle itself";
  EXPECT_GE(passage.depth, passage.at_nodes - kPassageResolution);
  EXPECT_NE(reported.report.status_text().find("m at nodes, whose rows are soft"),
            std::string::npos)
      << reported.report.status_text();
  scene.planner.between_nodes = BetweenNodes::refine;
  expect_same(Planner(scene).plan(scene.first), reported);
  scene.planner.between_nodes = BetweenNodes::ignore;
  EXPECT_EQ(Planner(scene).plan(scene.first).report.status, PlanStatus::solved);
}

TEST(BetweenNodes, TheDepthAtNodesIsTheDeepestThere) {
  const Task task;
  Plan plan;
  plan.t_start = 1;
  plan.t = {0, 1, 2};
  for (const double x : {0., 10., 20.}) plan.states.push_back({x, 0, 0, 0, 0, 0, 10, 0});
  world::Obstacle beside{"beside", 10, 3, 1, 1};
  beside.margin_start = 0.25;
  const world::Obstacle comes{"comes", 80, 0, 1, 1, -20, 0};  // at 20 when the plan is there
  const world::Footprint point(task.vehicle);
  EXPECT_NEAR(deepest_at_nodes(plan, {beside}, 2.5, point), 2.75 - 2, 1e-12);
  EXPECT_NEAR(deepest_at_nodes(plan, {beside, comes}, 2.5, point), 2.5 + 1, 1e-12);
  plan.obstacle_time_held = 0.5;
  EXPECT_NEAR(deepest_at_nodes(plan, {beside, comes}, 2.5, point), 0.75, 1e-12);
}

/// Planned 1 s before the time that obstacles are placed by.
TEST(BetweenNodes, HeldObstaclesStandWhereTheyWereBeforeTimeBegan) {
  const Task task;
  Plan plan;
  plan.t_start = -0.5;
  plan.obstacle_time_held = -1;
  plan.t = {0, 1, 2};
  plan.controls.resize(3);
  for (const double x : {0., 10., 20.}) plan.states.push_back({x, 0, 0, 0, 0, 0, 10, 0});
  const world::Obstacle goes{"goes", 25, 0, 1, 1, 20, 0};  // at 5 when planned, ahead from then on
  const world::Footprint point(task.vehicle);
  EXPECT_NEAR(deepest_passage(plan, {goes}, 2, point, task.vehicle.la).depth, 3, 0.1);
  EXPECT_EQ(deepest_at_nodes(plan, {goes}, 4.5, point), 0.5);
}

std::shared_ptr<const world::Road> road_of(const std::vector<world::RoadPoint>& points) {
  return std::make_shared<world::Road>(points, false, std::vector<std::vector<world::Point>>{},
                                       "road");
}

/// 60 m eastwards, then half around to the left by a radius of 14 m, 5.5 m wide, for a body and
/// with so few nodes that one is 10 m from the next.
Scene tight_bend() {
  constexpr double kRadius = 14, kHalf = 2.75, kStep = std::numbers::pi / 18;
  std::vector<world::RoadPoint> points;
  for (double x = -20; x <= 60; x += 10) points.push_back({x, 0, kHalf, kHalf});
  for (int k = 1; k < 18; ++k)
    points.push_back(
        {60 + kRadius * std::sin(k * kStep), kRadius * (1 - std::cos(k * kStep)), kHalf, kHalf});
  for (double x = 60; x >= -20; x -= 10) points.push_back({x, 2 * kRadius, kHalf, kHalf});
  Scene scene;
  scene.vehicle.footprint = vehicle::FootprintKind::rectangle;
  scene.road = road_of(points);
  scene.goal.s = 140;
  scene.goal = world::placed(scene.goal, scene.road.get());
  scene.planner.N = 4;
  scene.first = {{50, 0, 0, 0, 0, 0, 7, 0}, 0, 0.5};
  return scene;
}

/// How far a plan's body goes beyond the road's edges between its nodes, by its controls on the
/// reference model.
double farthest_driven(const Scene& scene, const Plan& plan) {
  const world::Footprint footprint(scene.vehicle);
  double most = 0;
  for (double t = 0.02; t <= plan.tf; t += 0.02)
    most = std::max(most, -footprint.edge_distance(*scene.road, integrate(plan, t)));
  return most;
}

TEST(BetweenNodes, APlanOffItsRoadSaysSoAndIsDriven) {
  Scene scene = tight_bend();
  scene.planner.between_nodes = BetweenNodes::report;
  const Plan plan = Planner(scene).plan(scene.first);
  ASSERT_TRUE(plan.report.solved);
  EXPECT_GE(least_edge_distance(scene, plan), -1e-3);  // at its nodes it is on the road
  EXPECT_EQ(plan.report.status, PlanStatus::passes_through) << plan.report.status_text();
  EXPECT_GT(plan.report.road_exit.depth, 0.05);
  EXPECT_EQ(plan.report.passage.depth, 0);
  EXPECT_NE(plan.report.status_text().find("m off the road at its left edge at"), std::string::npos)
      << plan.report.status_text();
  scene.planner.between_nodes = BetweenNodes::ignore;
  const Plan ignored = Planner(scene).plan(scene.first);
  EXPECT_EQ(ignored.report.status, PlanStatus::solved);
  EXPECT_EQ(ignored.report.road_exit.depth, 0);
  expect_same(ignored, plan);
}

TEST(BetweenNodes, BodiesAndShapesAreRefinedAsTheyAre) {
  Scene scene = tight_bend();
  EXPECT_EQ(scene.planner.between_nodes, BetweenNodes::by_shape);
  const Plan refined = Planner(scene).plan(scene.first);
  EXPECT_EQ(refined.report.status, PlanStatus::solved) << "the vehicle has a body";
  EXPECT_GT(refined.t.size(), static_cast<std::size_t>(scene.planner.N) + 1);
  Scene plain = wrong_way();
  EXPECT_FALSE(refines(plain));
  EXPECT_EQ(Planner(plain).plan(plain.first).report.status, PlanStatus::passes_through);
  plain.obstacles[0].psi = 0.3;
  plain.obstacles[0].b += 1;
  EXPECT_TRUE(refines(plain));
}

TEST(BetweenNodes, RefinedItStaysOnItsRoad) {
  Scene scene = tight_bend();
  scene.planner.between_nodes = BetweenNodes::refine;
  const Plan plan = Planner(scene).plan(scene.first);
  expect_solved(plan);
  EXPECT_EQ(plan.report.status, PlanStatus::solved) << plan.report.status_text();
  EXPECT_GT(plan.t.size(), 5);
  EXPECT_LT(farthest_driven(scene, plan), kPassageResolution);
}

/// The chord of an arc: a plan of two nodes, 0.1 m within the inner edge, of a point and of a body.
TEST(BetweenNodes, TheWayBeyondAnEdgeIsExact) {
  constexpr double kRadius = 20, kHalf = 3, kAngle = std::numbers::pi / 12, kSpeed = 10;
  for (const bool left : {true, false}) {
    const double side = left ? 1 : -1;
    std::vector<world::RoadPoint> points;
    for (double a = -1.5; a < 1.5; a += 0.1)
      points.push_back({kRadius * std::sin(a), side * kRadius * (1 - std::cos(a)), kHalf, kHalf});
    const auto road = road_of(points);
    Task task;
    const double inner = kRadius - kHalf + 0.1, chord = inner * std::sin(kAngle);
    Plan plan;
    plan.t_start = 2;
    plan.t = {0, 2 * chord / kSpeed};
    for (const double x : {-chord, chord})
      plan.states.push_back(
          {x, side * (kRadius - inner * std::cos(kAngle)), 0, 0, 0, 0, kSpeed, 0});
    const double depth = kRadius - kHalf - inner * std::cos(kAngle);
    auto exit = farthest_exit(plan, *road, world::Footprint(task.vehicle), task.vehicle.la);
    EXPECT_NEAR(exit.depth, depth, kPassageResolution);
    EXPECT_STREQ(exit.edge(), left ? "left" : "right");
    EXPECT_NEAR(exit.t, 2 + chord / kSpeed, 0.2);
    task.vehicle.footprint = vehicle::FootprintKind::rectangle;
    exit = farthest_exit(plan, *road, world::Footprint(task.vehicle), task.vehicle.la);
    EXPECT_NEAR(exit.depth, depth + task.vehicle.width / 2, kPassageResolution);
    plan.states[0][vehicle::Y] = plan.states[1][vehicle::Y] = 0;  // along the tangent
    exit = farthest_exit(plan, *road, world::Footprint(task.vehicle), task.vehicle.la);
    EXPECT_EQ(exit.depth, 0);
    EXPECT_STREQ(exit.edge(), "");
  }
}

TEST(RetrySides, NoPlanIsLostByIt) {
  for (int N = 8; N <= 20; ++N) {
    Scene scene = E_B();
    scene.planner.N = N;
    scene.obstacles = {{"wall", 202, 45, 14, 2, 0, 0}};
    const bool before = Planner(scene).plan(scene.first).report.solved;
    scene.planner.retry_sides = true;
    EXPECT_GE(Planner(scene).plan(scene.first).report.solved, before) << N;
  }
}

/// Straight on through the middle of a box neither side is downhill.
TEST(RetrySides, ABoxAcrossTheWayIsPassedOnASide) {
  for (const int N : {10, 11, 15}) {
    SCOPED_TRACE(N);
    Scene scene;
    scene.planner.N = N;
    scene.goal = {.x = 120, .y = 0, .psi = 0, .sigma = 8};
    const auto box = world::Polygon::rectangle(4.5, 12);
    scene.obstacles = {{"box", 40, 0, box.reach(), box.reach()}};
    scene.obstacles[0].outline = std::make_shared<world::Polygon>(box);
    scene.first = {{8.5, 0, 0, 0, 0, 0, 17, 0}, 0, 0.5};
    EXPECT_EQ(Planner(scene).plan(scene.first).report.status, PlanStatus::infeasible);
    scene.planner.retry_sides = true;
    const Plan plan = Planner(scene).plan(scene.first);
    expect_solved(plan);
    for (std::size_t k = 1; k < plan.t.size(); ++k)
      EXPECT_GT(world::distance(scene.obstacles[0], plan.states[k][0], plan.states[k][1], 0),
                scene.planner.sm_start)
          << k;
  }
}

}  // namespace
}  // namespace slalom::planner
