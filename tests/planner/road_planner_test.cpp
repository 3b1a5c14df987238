// The planner that verifies on a road.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "../../src/planner/road_reference.hpp"
#include "../../src/planner/verifier.hpp"
#include "planner/edge_distance.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/world/trajectory.hpp"
#include "world/ring.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

constexpr double kPi = std::numbers::pi;

/// Eastwards, and to the left along a bend of radius 40 m about (30, 40).
std::shared_ptr<const world::Road> bend(double width = 4) {
  std::vector<world::RoadPoint> line;
  for (double x = -20; x <= 30; x += 5) line.push_back({x, 0, width, width});
  for (double angle = 0.125; angle < kPi / 2; angle += 0.125)
    line.push_back({30 + 40 * std::sin(angle), 40 - 40 * std::cos(angle), width, width});
  for (double y = 45; y <= 90; y += 5) line.push_back({70, y, width, width});
  return std::make_shared<world::Road>(line, false, std::vector<std::vector<world::Point>>{},
                                       "bend");
}

Task on_bend() {
  Task task;
  task.vehicle.tyre_asymmetry = false;
  task.vehicle.footprint = FootprintKind::rectangle;
  task.planner.method = Method::verified;
  task.planner.arrival_N = 20;
  task.planner.search_places = 20'000;
  task.planner.verified_clearance = 0.3;
  task.planner.kept_clearance = 0.2;
  task.road = bend();
  task.goal.s = 110;
  task.goal = world::placed(task.goal, task.road.get());
  return task;
}

Request first() {
  Request request;
  request.X0p = {0, 0, 0, 0, 0, 0, 12, 0};
  return request;
}

TEST(RoadPlanner, DrivesAlongABendToALine) {
  const Task task = on_bend();
  const Plan plan = Planner(task).plan(first());
  EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
  EXPECT_TRUE(plan.goal_in_range);
  EXPECT_GE(least_edge_distance(task, plan), task.planner.edge_clearance);
  EXPECT_TRUE(std::any_of(plan.states.begin(), plan.states.end(),
                          [&](const State& x) { return task.arrived(x, 0); }));
}

TEST(RoadPlanner, ComesAsFarAsItCanInATime) {
  Task task = on_bend();
  task.goal = {};
  task.goal.time = 6;
  task.goal = world::placed(task.goal, task.road.get());
  const Plan plan = Planner(task).plan(first());
  EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
  const auto at = std::lower_bound(plan.t.begin(), plan.t.end(), 6 - plan.t_start) - plan.t.begin();
  const State& end = plan.states[static_cast<std::size_t>(at)];
  EXPECT_GT(task.road->project({end[X], end[Y]}).s - 20, 58);  // some 11 m/s in the bend
  EXPECT_GE(least_edge_distance(task, plan), task.planner.edge_clearance);
}

// What has crossed the seam of a closed road has come farther than what has not.
TEST(RoadPlanner, ByATimeTheSeamCostsNothing) {
  Task task = on_bend();
  task.road = world::test::ring(150, 4);
  task.goal = {};
  task.goal.time = 6;
  task.goal = world::placed(task.goal, task.road.get());
  const auto at = task.road->at(task.road->length() - 78);
  Request request = first();
  request.X0p = {at.x, at.y, 0, 0, at.psi, 0, 12, 0};
  // As fast as it can it comes some 6 m beyond the seam at least; at 12 m/s 6 m before it.
  const auto cost = [&](double fastest) {
    task.vehicle.ux_max = fastest;
    const Plan plan = Planner(task).plan(request);
    EXPECT_TRUE(plan.certificate.verified && plan.goal_in_range) << plan.certificate.refused;
    return plan.report.cost / task.planner.w_t;
  };
  EXPECT_LT(cost(29), cost(13) - 0.5);
}

TEST(RoadPlanner, MeetsWhatIsAskedOnArrival) {
  Task task = on_bend();
  task.goal = {.x = 70, .y = 75, .psi = kPi / 2, .length = 8, .width = 5};
  task.goal.psi_tolerance = 0.2;
  task.goal.ux_max = 7;
  const Plan plan = Planner(task).plan(first());
  ASSERT_TRUE(plan.goal_in_range) << plan.certificate.refused;
  EXPECT_TRUE(std::any_of(plan.states.begin(), plan.states.end(),
                          [&](const State& x) { return task.arrived(x, 0); }));
}

TEST(RoadPlanner, AStopKeepsToTheRoad) {
  Task task = on_bend();
  // A wall across the bend.
  task.obstacles = {{"wall", 60, 12, 7, 7, 0, 0}};
  const Plan plan = Planner(task).plan(first());
  EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
  EXPECT_FALSE(plan.goal_in_range);
  EXPECT_LT(plan.states.back()[UX], 0.5);
  EXPECT_GE(least_edge_distance(task, plan), task.planner.edge_clearance);
}

std::shared_ptr<const world::Road> straight_road() {
  return std::make_shared<world::Road>(
      std::vector<world::RoadPoint>{{-50, 0, 4, 4}, {50, 0, 4, 4}, {200, 0, 4, 4}}, false,
      std::vector<std::vector<world::Point>>{}, "straight");
}

/// The plant's motion straight on from x = 0 at an offset to the right of the line, on a straight
/// road of width 2 * 4 m.
Verdict judged(double offset, double edge) {
  Task task = on_bend();
  task.road = straight_road();
  task.goal = {};
  task.goal.s = 100;
  task.goal = world::placed(task.goal, task.road.get());
  const Plant plant = Verifier::believed_plant(task.vehicle);
  Motion motion;
  State x = {0, -offset, 0, 0, 0, 0, 15, 0};
  for (int k = 0; k <= 100; ++k) {
    motion.add(0.05 * k, x, {});
    x = plant.advance(x, {}, {}, 0.05 * k, 0.05 * (k + 1));
  }
  Verifier verifier(task, plant);
  return verifier.judge(motion, {}, {0.3, 400, {}, edge}, {motion.begin(), 0.5});
}

TEST(RoadPlanner, ACentimetreOffTheRoadIsRefusedAndACentimetreOnItIsNot) {
  const double half = on_bend().vehicle.width / 2;
  EXPECT_TRUE(judged(4 - half - 0.01, 0).certificate.verified);
  EXPECT_TRUE(judged(4 - half - 0.06, 0.05).certificate.verified);
  // The first second it may come back from where it begins.
  const Verdict off = judged(4 - half + 0.01, 0);
  EXPECT_FALSE(off.certificate.verified);
  EXPECT_NE(off.certificate.refused.find("off the road"), std::string::npos);
  EXPECT_FALSE(judged(4 - half - 0.04, 0.05).certificate.verified);
}

TEST(RoadPlanner, AReferenceMovesOverByAShareOfTheRoom) {
  const Task task = on_bend();
  const auto road = straight_road();
  const State X0 = {0, 0.5, 0, 0, 0, 0, 12, 0};
  const double room = 4 - task.vehicle.width / 2 - 0.1;
  const auto end = [&](double aside) {
    return road_reference(*road, X0, 0, 3, 3, task.vehicle, aside).states.back()[Y];
  };
  EXPECT_NEAR(end(0), 0.5, 1e-9);
  EXPECT_NEAR(end(-1), -room, 0.02);
  EXPECT_NEAR(end(1), room, 0.02);
  EXPECT_NEAR(end(-0.5), (0.5 - room) / 2, 0.02);
}

/// Along a straight, with no search in the plane.
Task on_straight() {
  Task task = on_bend();
  task.road = straight_road();
  task.goal = {};
  task.goal.s = 150;
  task.goal = world::placed(task.goal, task.road.get());
  task.planner.search_places = 1;
  task.vehicle.sr_max_deg = 25;
  return task;
}

/// Where every motion is refused, for a clearance that there is nowhere, the one that touches
/// nothing is driven: beside what stands in the lane, which no stop along it avoids.
TEST(RoadPlanner, OfWhatIsRefusedItDrivesWhatDoesNoHarm) {
  Task task = on_straight();
  const Request request = first();
  const double t = request.t_start;
  task.planner.verified_clearance = task.planner.kept_clearance = 30;
  task.obstacles = {{"stands", 18, 1.2, 1, 1, 0, 0}};
  const Plan plan = Planner(task).plan(request);
  EXPECT_EQ(plan.rung, Rung::least_bad);
  EXPECT_FALSE(plan.certificate.verified);
  const world::Footprint footprint(task.vehicle);
  for (std::size_t k = 0; k < plan.t.size(); ++k) {
    EXPECT_GT(footprint.edge_distance(*task.road, plan.states[k]), 0) << plan.t[k];
    for (const auto& o : task.obstacles)
      EXPECT_GT(footprint.distance(o, plan.states[k], t + plan.t[k]), 0) << o.name << plan.t[k];
  }
}

/// Something as wide as the road comes from behind, and is gone in four seconds: whoever brakes at
/// once is hit, and the search among stops finds the one that goes on until then.
TEST(RoadPlanner, ItStopsWhenWhatComesFromBehindIsGone) {
  Task task = on_bend();
  task.road = straight_road();
  task.goal = {};
  task.goal.s = 150;
  task.goal.t_max = 2;  // nothing arrives
  task.goal = world::placed(task.goal, task.road.get());
  task.planner.guidance = false;
  task.vehicle.sr_max_deg = 25;
  task.vehicle.jx_max = 20;
  world::Obstacle chaser{"chaser", 0, 0, 3, 3, 0, 0};
  chaser.trajectory = std::make_shared<world::TableTrajectory>(
      std::vector<world::TrajectoryRow>{{0, -26, 0, 0}, {4, 31, 0, 0}}, world::BeyondEnd::goes_on,
      world::BeyondEnd::absent, "chaser");
  task.obstacles = {chaser};
  const Plan plan = Planner(task).plan(first());
  EXPECT_TRUE(plan.certificate.verified) << plan.report.detail;
  EXPECT_TRUE(std::any_of(plan.candidates.begin(), plan.candidates.end(), [](const auto& c) {
    return c.name == "stop in time" && c.certificate.verified;
  }));
}

/// Between two that leave less room than a new plan keeps, and no way to stop before them, a plan
/// keeps what the rest of one keeps.
TEST(RoadPlanner, WhereNothingKeepsMoreAPlanKeepsWhatARestKeeps) {
  Task task = on_bend();
  task.road = straight_road();
  task.goal = {};
  task.goal.s = 60;
  task.goal = world::placed(task.goal, task.road.get());
  task.vehicle.sr_max_deg = 25;
  const double aside = task.vehicle.width / 2 + 0.26 + 1;
  task.obstacles = {{"left", 12, aside, 1, 1, 0, 0}, {"right", 12, -aside, 1, 1, 0, 0}};
  const Plan plan = Planner(task).plan(first());
  EXPECT_TRUE(plan.certificate.verified) << plan.report.detail;
  EXPECT_EQ(plan.rung, Rung::new_plan);
  EXPECT_LT(plan.certificate.least_clearance, task.planner.verified_clearance);
  EXPECT_GE(plan.certificate.least_clearance, task.planner.kept_clearance);
  task.planner.kept_clearance = task.planner.verified_clearance;
  EXPECT_FALSE(Planner(task).plan(first()).certificate.verified);
}

/// What stands in the lane is so near that only the hardest swerve at once misses it.
TEST(RoadPlanner, ItEscapesWhereEverythingElseDoesHarmSoon) {
  Task task = on_straight();
  task.vehicle.jx_max = 20;
  task.obstacles = {{"stands", 11.2, 0.3, 1, 1, 0, 0}};
  const Plan plan = Planner(task).plan(first());
  EXPECT_TRUE(std::any_of(plan.candidates.begin(), plan.candidates.end(),
                          [](const auto& c) { return c.name == "escape"; }));
  const world::Footprint footprint(task.vehicle);
  for (std::size_t k = 0; k < plan.t.size(); ++k)
    EXPECT_GT(footprint.distance(task.obstacles[0], plan.states[k], 0), 0) << plan.t[k];
}

TEST(RoadPlanner, ACornerCutByACentimetreIsRefused) {
  Task task = on_bend();
  const Plan plan = Planner(task).plan(first());
  ASSERT_TRUE(plan.certificate.verified);
  Motion motion;
  for (std::size_t k = 0; k < plan.t.size(); ++k)
    motion.add(plan.t[k], plan.states[k], plan.controls[k]);
  const double spare = least_edge_distance(task, plan);
  const Plant plant = Verifier::believed_plant(task.vehicle);
  for (const double beyond : {-0.012, 0.01}) {
    task.road = bend(4 - spare - beyond);
    const Verdict verdict =
        Verifier(task, plant).judge(motion, {}, {0.3, 200, {}, 0}, {motion.begin(), 0.5});
    EXPECT_EQ(verdict.certificate.verified, beyond < 0) << verdict.certificate.refused;
  }
}

TEST(RoadPlanner, AReferenceFollowsTheRoadAtItsOffset) {
  const auto road = bend();
  const Motion motion =
      road_reference(*road, {0, 1, 0, 0, 0, 0, 10, 0}, 2, 8, 0, on_bend().vehicle);
  for (std::size_t k = 0; k < motion.size(); ++k)
    EXPECT_NEAR(road->project({motion.states[k][X], motion.states[k][Y]}).n, 1, 0.02);
  EXPECT_NEAR(motion.end(), 10, 1e-9);
  // One that heads for the edge turns into the road.
  const Motion turned =
      road_reference(*road, {0, 1, 0, 0, 0.3, 0, 10, 0}, 2, 8, 0, on_bend().vehicle);
  const State& last = turned.states.back();
  EXPECT_LT(road->project({last[X], last[Y]}).n, 4 - on_bend().vehicle.width / 2);
}

}  // namespace
}  // namespace slalom::planner
