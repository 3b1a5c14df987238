// Obstacles with shapes, headings and trajectories, and a vehicle with a body.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "../../src/planner/between_nodes.hpp"
#include "../../src/planner/obstacle_view.hpp"
#include "../../src/planner/verifier.hpp"
#include "planner/expect_plan.hpp"
#include "planner/scenes.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;
using world::BeyondEnd;
using world::Footprint;
using world::Obstacle;
using world::TableTrajectory;

constexpr double kNorth = std::numbers::pi / 2;

Obstacle box(double x, double y, double length, double width, double psi) {
  Obstacle o{"box", x, y};
  o.outline = std::make_shared<world::Polygon>(world::Polygon::rectangle(length, width));
  o.a = o.b = o.outline->reach();
  o.psi = psi;
  return o;
}

Obstacle along(Obstacle o, std::vector<world::TrajectoryRow> rows, BeyondEnd before,
               BeyondEnd after) {
  o.trajectory = std::make_shared<TableTrajectory>(std::move(rows), before, after, "table");
  return o;
}

/// Northwards along x = 0 at 20 m/s from t = 1 on, for 5 s, with the body of the vehicle file: 2 m
/// wide; into the goal's square.
struct Bodies : ::testing::Test {
  Task task;
  Motion motion;
  Need need{0.5, 400};

  Bodies() {
    task.vehicle.tyre_asymmetry = false;
    task.vehicle.footprint = FootprintKind::rectangle;
    task.goal = {0, 100, kNorth, 15};
    drive(20);
  }
  void drive(double speed) {
    motion = {};
    for (int k = 0; k <= 100; ++k)
      motion.add(1 + 0.05 * k, {0, 0.05 * k * speed, 0, 0, kNorth, 0, speed, 0}, {});
  }
  Verdict judge(const std::vector<Obstacle>& obstacles) {
    const Plant plant(task.vehicle, 1e-9, 0.02);
    return Verifier(task, plant).judge(motion, obstacles, need, {motion.begin(), 0.5});
  }
};

// A corner of a box, turned by 45 degrees, .45 m or .55 m beside the body and 1.45 m or 1.55 m
// beside the front axle's centre.
TEST_F(Bodies, TheVehiclesBodyKeepsOffTheCornerOfABox) {
  for (const double spare : {-0.05, 0.05}) {
    const double side = 1.2, x = 1 + 0.5 + spare + side / std::numbers::sqrt2;
    const std::vector<Obstacle> obstacles = {box(x, 50, side, side, std::numbers::pi / 4)};
    const Verdict verdict = judge(obstacles);
    EXPECT_EQ(verdict.certificate.verified, spare > 0) << spare;
    EXPECT_EQ(verdict.certificate.nearest, "box");
    EXPECT_NEAR(verdict.certificate.least_clearance, 0.5 + spare, 0.01);
    task.vehicle.footprint = FootprintKind::point;
    EXPECT_TRUE(judge(obstacles).certificate.verified) << "as a point it stays 1.45 m off";
    task.vehicle.footprint = FootprintKind::rectangle;
  }
}

TEST_F(Bodies, WhatIsAbsentIsNotInTheWay) {
  const std::vector<world::TrajectoryRow> across = {{3, 0, 40, 0}, {6, 0.5, 40, 0}};
  const auto beside = box(0, 0, 4, 2, 0);
  // The vehicle is there at 3 s.
  EXPECT_FALSE(
      judge({along(beside, across, BeyondEnd::stands, BeyondEnd::stands)}).certificate.verified);
  auto late = across;
  for (auto& row : late) row.t += 0.5;
  EXPECT_FALSE(
      judge({along(beside, late, BeyondEnd::stands, BeyondEnd::stands)}).certificate.verified);
  EXPECT_TRUE(
      judge({along(beside, late, BeyondEnd::absent, BeyondEnd::stands)}).certificate.verified);
  auto early = across;
  for (auto& row : early) row.t -= 3.5;
  EXPECT_TRUE(
      judge({along(beside, early, BeyondEnd::stands, BeyondEnd::absent)}).certificate.verified);
}

// A bar beside the way turns by a right angle and back within .4 s; its tip then is .2 m beside the
// body, if that is there.
TEST_F(Bodies, ABarThatTurnsIsSeenBetweenKnots) {
  need.clearance = 0.3;
  for (const double off : {0., 0.5}) {
    const double t = 1 + 51. / 20 + off;  // at 3.55 s the body's middle passes
    const auto turning = along(box(0, 0, 8, 0.4, 0),
                               {{0, 5.2, 50, kNorth},
                                {t - 0.2, 5.2, 50, kNorth},
                                {t, 5.2, 50, 0},
                                {t + 0.2, 5.2, 50, kNorth},
                                {9, 5.2, 50, kNorth}},
                               BeyondEnd::stands, BeyondEnd::stands);
    const auto verdict = judge({turning});
    EXPECT_EQ(verdict.certificate.verified, off > 0) << off << verdict.certificate.refused;
    EXPECT_LT(verdict.certificate.least_clearance, off > 0 ? 3 : 0.3);
  }
}

TEST_F(Bodies, MarginsGrowFromTheMomentOfPlanning) {
  auto o = box(2.6, 41, 2, 2, 0);  // .6 m beside the body from 3 s on, for about .3 s
  EXPECT_TRUE(judge({o}).certificate.verified);
  o.margin_start = 0.2;
  EXPECT_FALSE(judge({o}).certificate.verified);
  o.margin_start = 0;
  o.margin_rate = 0.1;
  EXPECT_FALSE(judge({o}).certificate.verified) << ".2 m and more";
  o.predicted_at = 2.9;
  EXPECT_TRUE(judge({o}).certificate.verified) << "less than .1 m";
  EXPECT_NEAR(judge({o}).certificate.least_clearance, 0.6, 0.01) << "to the edge itself";
}

TEST_F(Bodies, NoneStandsInTheWayOfATable) {
  task.planner.standing_horizon = 20;
  drive(0.1);
  const auto car = box(0, 0, 4, 2, 0);
  const auto passing = [&](double y, BeyondEnd after) {
    return along(car, {{0, -60, y, 0}, {15, -30, y, 0}, {18, -20, y, 0}}, BeyondEnd::stands, after);
  };
  EXPECT_TRUE(judge({passing(0, BeyondEnd::stands)}).certificate.verified);
  EXPECT_TRUE(judge({passing(0, BeyondEnd::absent)}).certificate.verified);
  const auto verdict = judge({passing(0, BeyondEnd::goes_on)});
  EXPECT_FALSE(verdict.certificate.verified);
  EXPECT_NE(verdict.certificate.refused.find("standing in the way of box"), std::string::npos);
  EXPECT_TRUE(judge({passing(9, BeyondEnd::goes_on)}).certificate.verified);
}

TEST(Believed, ATrajectoryIsKnownOrGoesOnAsItMovesNow) {
  const auto turning =
      along(box(0, 0, 4, 2, 0), {{0, 0, 0, 0}, {1, 10, 0, 0.5}, {2, 18, 6, 1.2}, {3, 20, 15, 1.5}},
            BeyondEnd::absent, BeyondEnd::goes_on);
  Settings s;
  EXPECT_EQ(believed(s, {turning}, 1)[0].trajectory, turning.trajectory);
  const auto now = turning.pose_at(1.2);
  s.prediction = Prediction::constant_velocity;
  const auto straight = believed(s, {turning}, 1.2)[0];
  EXPECT_FALSE(straight.trajectory);
  EXPECT_EQ(straight.outline, turning.outline);
  EXPECT_NEAR(straight.x_at(2.2), now.x + now.vx, 1e-12);
  EXPECT_NEAR(straight.y_at(2.2), now.y + now.vy, 1e-12);
  EXPECT_DOUBLE_EQ(straight.psi, now.psi);
  EXPECT_TRUE(believed(s, {turning}, -0.5).empty()) << "it is not there yet";
  s.prediction = Prediction::constant_turn;
  const auto circling = believed(s, {turning}, 1.2)[0].pose_at(2.2);
  EXPECT_NEAR(circling.psi, now.psi + now.omega, 1e-12);
  EXPECT_NEAR(std::hypot(circling.vx, circling.vy), std::hypot(now.vx, now.vy), 1e-12);
}

/// Plans northwards at 15 m/s in the right lane; a car comes in the left one and turns across.
struct TurningCar : ::testing::Test {
  Scene scene;

  TurningCar() {
    scene.goal = {.x = 0, .y = 200, .psi = kNorth, .sigma = 5};
    scene.region.x_min = -12;
    scene.region.x_max = 12;
    scene.first = {{0, 0, 0, 0, kNorth, 0, 15, 0}, 0, 0.5};
    scene.planner.between_nodes = BetweenNodes::report;
    scene.obstacles = {along(box(0, 0, 4.5, 1.8, 0),
                             {{0, -6, 60, -kNorth},
                              {1, -6, 52, -kNorth},
                              {2, -5, 44.5, -1},
                              {3, 0, 42, 0},
                              {4, 3, 42, 0}},
                             BeyondEnd::stands, BeyondEnd::stands)};
  }
  /// How deep the plan goes into the car as it really drives.
  double depth(const Plan& plan) const {
    const Footprint footprint(scene.vehicle);
    return deepest_passage(plan, scene.obstacles, scene.planner.sm_start, footprint,
                           scene.vehicle.la)
        .depth;
  }
};

TEST_F(TurningCar, IsPassedWhereItsTableIsKnown) {
  for (const auto kind : {FootprintKind::point, FootprintKind::rectangle}) {
    scene.vehicle.footprint = kind;
    Planner planner(scene);
    (void)planner.plan(scene.first);  // when the vehicle is where, the first plan tells
    const Plan plan = planner.plan(scene.first);
    expect_solved(plan);
    EXPECT_LT(depth(plan), scene.planner.passage_depth);
  }
}

TEST_F(TurningCar, IsHitByAPlanThatBelievesItGoesStraightOn) {
  scene.planner.prediction = Prediction::constant_velocity;
  Planner planner(scene);
  (void)planner.plan(scene.first);
  const Plan plan = planner.plan(scene.first);
  expect_solved(plan);
  EXPECT_GT(depth(plan), 1);
}

TEST_F(TurningCar, ItsNameIsWhatStandsInTheWay) {
  scene.obstacles = {box(0, 30, 8, 6, 0.5)};
  scene.planner.max_iterations = 1;
  scene.vehicle.footprint = FootprintKind::rectangle;
  const Plan plan = Planner(scene).plan(scene.first);
  EXPECT_FALSE(plan.report.solved);
  EXPECT_EQ(plan.report.blocks.substr(0, 14), "box in the way") << plan.report.blocks;
}

}  // namespace
}  // namespace slalom::planner
