// The paper's planner on a road: its OCP as if the road's line were unrolled.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "../../src/planner/drivable_speed.hpp"
#include "../../src/planner/guess.hpp"
#include "../../src/planner/road_terms.hpp"
#include "../../src/planner/road_way.hpp"
#include "../../src/planner/trajectory_problem.hpp"
#include "edge_distance.hpp"
#include "scenes.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/planner/planner.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;
using world::Point;
using world::RoadPoint;

constexpr double kPi = std::numbers::pi;

std::shared_ptr<const world::Road> road_of(std::vector<RoadPoint> points, bool closed = false) {
  return std::make_shared<world::Road>(std::move(points), closed, std::vector<std::vector<Point>>{},
                                       "road");
}

/// Northwards about x = 12, where E_C's region ends on both sides.
std::shared_ptr<const world::Road> beside_E_C(double left, double right) {
  return road_of({{12, -50, right, left}, {12, 800, right, left}});
}

/// 100 m eastwards, half around to the left by a radius of 15 m, and back 30 m beside it.
std::shared_ptr<const world::Road> hairpin() {
  std::vector<RoadPoint> points;
  for (double x = -20; x <= 100; x += 10) points.push_back({x, 0, 4, 4});
  for (double angle = -80; angle <= 80; angle += 10)
    points.push_back(
        {100 + 15 * std::cos(angle * kPi / 180), 15 + 15 * std::sin(angle * kPi / 180), 4, 4});
  for (double x = 100; x >= -40; x -= 10) points.push_back({x, 30, 4, 4});
  return road_of(points);
}

Task on(std::shared_ptr<const world::Road> road, double goal_s) {
  Task task;
  task.vehicle.footprint = FootprintKind::rectangle;
  task.road = std::move(road);
  task.goal.s = goal_s;
  task.goal = world::placed(task.goal, task.road.get());
  return task;
}

Request at(double x, double y, double psi, double ux) {
  Request request;
  request.X0p = {x, y, 0, 0, psi, 0, ux, 0};
  return request;
}

int edges_of(const Task& task) {
  const TrajectoryProblem problem(task, {}, false);
  const auto& rows = problem.problem().constraints();
  return static_cast<int>(std::count_if(rows.begin(), rows.end(), [](const auto& row) {
    return row.name.find("edge of the road") != std::string::npos;
  }));
}

TEST(RoadHorizon, AStraightRoadGivesThePlanWithoutIt) {
  const Scene plain = E_C();
  Scene instead = plain, beside = plain;
  instead.road = beside_E_C(12, 12);
  instead.region = {};
  beside.road = beside_E_C(20, 13);
  const Plan wanted = Planner(plain).plan(plain.first);
  ASSERT_TRUE(wanted.report.solved);
  for (const Scene& scene : {instead, beside}) {
    const Plan plan = Planner(scene).plan(scene.first);
    ASSERT_TRUE(plan.report.solved) << plan.report.status_text();
    ASSERT_EQ(plan.states.size(), wanted.states.size());
    EXPECT_NEAR(plan.tf, wanted.tf, 1e-4);
    for (std::size_t k = 0; k < plan.states.size(); ++k)
      for (std::size_t i = 0; i < kStates; ++i)
        EXPECT_NEAR(plan.states[k][i], wanted.states[k][i], 1e-3) << k << " " << kStateNames[i];
  }
}

TEST(RoadHorizon, AnEdgeThatTheRegionKeepsTheVehicleFromHasNoRows) {
  Task task = E_C();
  task.road = beside_E_C(12, 12);
  EXPECT_EQ(edges_of(task), 0);
  task.road = beside_E_C(12, 11);
  EXPECT_EQ(edges_of(task), 1);
  task.planner.edge_clearance = 0.1;
  task.road = beside_E_C(12, 12);
  EXPECT_EQ(edges_of(task), 2);
  task.vehicle.footprint = FootprintKind::rectangle;  // rows for its rear, its middle and its front
  EXPECT_EQ(edges_of(task), 6);
}

TEST(RoadHorizon, OffsetsFromTheLineAreTheRoadsOwn) {
  const auto road = hairpin();
  const RoadTables tables(*road, 0, 0, 0);
  const auto s = expr::Expr::symbol("s"), x = expr::Expr::symbol("x"), y = expr::Expr::symbol("y");
  const auto line = tables.at(s);
  const expr::Function offset({s, x, y}, {}, {line.offset(x, y), line.left, line.right});
  for (double along = 5; along < road->length(); along += 7.3)
    for (const double n : {-3., 0., 2.5}) {
      const auto place = road->at(along);
      const Point p = place.point() + place.aside() * n;
      for (const double off : {-0.3, 0., 0.4}) {  // of s
        std::array<double, 3> values{};
        offset(std::array{along + off, p.x, p.y}, {}, values);
        EXPECT_NEAR(values[0], n, 0.01) << along << " " << off;
        EXPECT_NEAR(values[1], 4, 1e-9);
        EXPECT_NEAR(values[2], 4, 1e-9);
      }
    }
}

TEST(RoadHorizon, RangesAreMeasuredAlongTheRoad) {
  const auto road = hairpin();
  Task task = on(road, road->project({60, 30}).s);
  task.planner.L_range = 60;
  // The way back is 30 m beside the way there, and more than 100 m on.
  WayAhead way = way_ahead(task, at(60, 0, 0, 10), std::nullopt);
  EXPECT_NEAR(way.ahead, 40 + 15 * kPi + 40, 1);
  EXPECT_FALSE(way.in_range);
  way = way_ahead(task, at(110, 26, 2.3, 10), std::nullopt);
  EXPECT_TRUE(way.in_range);
  EXPECT_NEAR(way.aim, task.goal.s + 1, 1e-9);  // over the line
  way = way_ahead(task, at(60.5, 30, kPi, 10), std::nullopt);
  EXPECT_NEAR(way.aim - way.s, 0.5 * 10, 1e-9);  // half a second on
}

TEST(RoadHorizon, TheBranchIsTheVehiclesOwn) {
  // Where a vehicle is wrongly seen nearer to the way back, it is still on the way there.
  const auto road = hairpin();
  const Task task = on(road, 250);
  const Request request = at(60, 15.2, 0, 10);
  EXPECT_GT(way_ahead(task, request, std::nullopt).s, 150);
  EXPECT_NEAR(way_ahead(task, request, 78).s, 80, 0.1);
  const auto along = follow(*road, 80, {{60, 15.2}, {66, 15.2}, {72, 14}});
  EXPECT_NEAR(along[1], 86, 0.1);
  EXPECT_NEAR(along[2], 92, 0.1);
}

TEST(RoadHorizon, GoalsOfEachKindHaveTheirPlaceAlongIt) {
  Task task = on(hairpin(), 100);
  const Request request = at(60, 0, 0, 10);  // at s = 80
  EXPECT_FALSE(goal_offset(task));
  task.goal = {.x = 90, .y = 2, .sigma = 5};
  EXPECT_NEAR(*goal_offset(task), 2, 1e-3);
  EXPECT_NEAR(way_ahead(task, request, std::nullopt).ahead, 30, 0.1);
  task.goal = {.x = 95, .y = -1, .psi = 0, .length = 4, .width = 4};
  EXPECT_NEAR(*goal_offset(task), -1, 0.1);  // the spline's line bends before its arc
  EXPECT_TRUE(way_ahead(task, request, std::nullopt).in_range);
  task.goal = {.x = 0, .y = 0, .sigma = 5};  // passed: the road goes on
  EXPECT_FALSE(way_ahead(task, request, std::nullopt).in_range);
  task.goal = {};
  task.goal.time = 5;
  EXPECT_FALSE(way_ahead(task, at(-30, 30, kPi, 10), std::nullopt).in_range);
}

TEST(RoadHorizon, AGuessBeyondAPassedGoalGoesAsFarAsItSees) {
  Task task = on(road_of({{-20, 0, 4, 4}, {300, 0, 4, 4}}), 100);
  task.goal = {50, 0, 0, 3};
  Guess guess(task);
  const auto length = [&](double x) {
    const Request request = at(x, 0, 0, 10);
    return guess(request, way_ahead(task, request, {}), nullptr).states.back()[X] - x;
  };
  EXPECT_NEAR(length(20), 30, 2);
  EXPECT_NEAR(length(80), task.planner.L_range, 2);
}

TEST(RoadHorizon, AClosedRoadGoesOnWhereItBegins) {
  std::vector<RoadPoint> ring;
  for (int k = 0; k < 72; ++k)
    ring.push_back({40 * std::cos(k * kPi / 36), 40 * std::sin(k * kPi / 36), 4, 4});
  Task task = on(road_of(ring, true), 20);
  const double length = task.road->length();
  const WayAhead way = way_ahead(task, at(40, -10, kPi / 2, 10), std::nullopt);
  EXPECT_NEAR(way.ahead, 20 + length - way.s, 1e-9);
  EXPECT_NEAR(way.aim, length + 21, 1e-9);
  const auto along = follow(*task.road, length - 1, {{40, -1}, {40, 1}, {39.5, 6}});
  EXPECT_GT(along[1], length);
  EXPECT_GT(along[2], along[1]);
}

TEST(RoadHorizon, PlansStayOnABend) {
  Task task = on(hairpin(), 250);
  for (const auto& [x, y, psi] : {std::tuple{85., 0., 0.}, {112., 6., 1.}, {114.5, 18., 1.7}}) {
    const Plan plan = Planner(task).plan(at(x, y, psi, 7));
    ASSERT_TRUE(plan.report.solved) << plan.report.status_text() << " " << plan.report.blocks;
    EXPECT_GE(least_edge_distance(task, plan), -0.02);
    // It goes as far as the range, along the road.
    const State& end = plan.states.back();
    const double s0 = task.road->project({x, y}).s;
    EXPECT_NEAR(task.road->project({end[X], end[Y]}, s0 + 48).s - s0, 47, 3);
  }
}

TEST(RoadHorizon, PlansEndNoFasterThanTheRoadAllows) {
  Task task = on(hairpin(), 250);
  const Plan plan = Planner(task).plan(at(30, 0, 0, 17));  // up to 50 m before the bend's middle
  ASSERT_TRUE(plan.report.solved) << plan.report.status_text();
  EXPECT_LT(plan.states.back()[UX], 13);
  task.road = road_of({{-50, 0, 4, 4}, {400, 0, 4, 4}});
  EXPECT_GT(Planner(task).plan(at(30, 0, 0, 17)).states.back()[UX], 17);
}

TEST(RoadHorizon, MeetsWhatIsAskedOnArrival) {
  Task task = on(road_of({{-50, 0, 4, 4}, {400, 0, 4, 4}}), 90);
  EXPECT_GT(Planner(task).plan(at(5, 0, 0, 15)).states.back()[UX], 15);
  task.goal.ux_max = 9;
  task.goal.psi_tolerance = 0.1;
  for (const bool road : {true, false}) {
    if (!road) {
      task.road = nullptr;
      task.goal = {.x = 40, .y = 0, .psi = 0, .length = 4, .width = 4, .ux_max = 9};
    }
    const Plan plan = Planner(task).plan(at(5, 0, 0, 15));
    ASSERT_TRUE(plan.report.solved) << plan.report.status_text();
    EXPECT_TRUE(plan.goal_in_range);
    EXPECT_LT(plan.states.back()[UX], 9);
    EXPECT_NEAR(plan.states.back()[PSI], 0, 0.1);
  }
}

TEST(RoadHorizon, SteeringLimitsTheSpeedWhereTheRoadLeavesLittleRoom) {
  Parameters car;
  const auto road = hairpin();
  const double s = 118;  // where the bend begins
  const double wide = steerable_speed(*road, car, s);
  EXPECT_GT(wide, 3);
  EXPECT_LT(wide, 12);
  car.footprint = FootprintKind::rectangle;
  EXPECT_LT(steerable_speed(*road, car, s), wide);
  car.sr_max_deg *= 2;
  EXPECT_NEAR(steerable_speed(*road, car, 40), car.ux_max, 1e-9);  // on the straight
  EXPECT_GT(steerable_speed(*road, car, s), wide);
  // It never rises faster than braking allows for, and is that of the straight before.
  const SpeedProfile speeds = drivable_speeds(*road, car, 0.8, 0.7);
  EXPECT_LE(speeds.at(s), steerable_speed(*road, car, s) + 0.5);
  EXPECT_GT(speeds.at(s - 40), speeds.at(s) + 3);
  EXPECT_GT(speeds.at(road->length() + 50), 20);  // the road goes on
}

}  // namespace
}  // namespace slalom::planner
