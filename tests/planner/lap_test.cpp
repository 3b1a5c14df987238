#include "slalom/planner/lap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/line_scenes.hpp"
#include "slalom/base/error.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/vehicle/plant.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// The control at a moment, linear between the lap's points.
Control control_at(const Lap& lap, double t) {
  const auto next = static_cast<std::size_t>(
      std::upper_bound(lap.t.begin() + 1, lap.t.end() - 1, t) - lap.t.begin());
  const double share = (t - lap.t[next - 1]) / (lap.t[next] - lap.t[next - 1]);
  Control u;
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = lap.controls[next - 1][i] + share * (lap.controls[next][i] - lap.controls[next - 1][i]);
  return u;
}

TEST(Lap, TheFastestStaysOnTheRoadAndThePlantDrivesIt) {
  const auto road = oval(110, 55, 5);
  const Lap lap = fastest_lap(*road, body(), {.interval = 5});
  ASSERT_EQ(lap.refined.status, ocp::RefineStatus::converged) << lap.refined.table();
  EXPECT_NEAR(lap.t.back(), lap.time, 1e-5 * lap.time);
  const world::Footprint footprint(body());
  const Plant plant(body(), 1e-9, 0.02);
  double least = INFINITY;
  for (std::size_t k = 0; k < lap.s.size(); ++k)
    least = std::min(least, footprint.edge_distance(*road, lap.states[k]));
  EXPECT_GT(least, -0.01);
  EXPECT_LT(least, 0.01);  // it uses all of the road
  // Two seconds from here and there, by the plant.
  for (std::size_t from = 0; from + 60 < lap.s.size(); from += 40) {
    State x = lap.states[from];
    std::size_t k = from;
    for (; lap.t[k] < lap.t[from] + 2 && k + 1 < lap.s.size(); ++k)
      x = plant.advance(x, control_at(lap, lap.t[k]), control_at(lap, lap.t[k + 1]), lap.t[k],
                        lap.t[k + 1]);
    EXPECT_NEAR(x[X], lap.states[k][X], 0.05) << lap.s[from];
    EXPECT_NEAR(x[Y], lap.states[k][Y], 0.05) << lap.s[from];
    EXPECT_NEAR(x[UX], lap.states[k][UX], 0.05) << lap.s[from];
  }
  for (std::size_t i = 2; i < kStates; ++i)
    if (i != PSI) EXPECT_NEAR(lap.states.front()[i], lap.states.back()[i], 1e-6);
}

/// On a circle a vehicle that only the speed bounds goes along the inner edge at that speed.
TEST(Lap, OnACircleItIsTheInnerEdgeAtTheTopSpeed) {
  const auto road = oval(100, 100, 4);
  Parameters slow = body();
  slow.ux_max = 8;
  const Lap lap = fastest_lap(*road, slow, {.interval = 10});
  ASSERT_TRUE(lap.refined.solution.solved());
  // Of the rear left corner of a body that slips little: the front axle goes farther out.
  const double rear = slow.length - slow.front_overhang;
  const double inner = 96 + slow.width / 2;
  const double beside = std::hypot(inner, slow.la + slow.lb);  // the rear axle's foot is nearest
  EXPECT_GT(rear, slow.la + slow.lb);
  EXPECT_NEAR(lap.time, 2 * std::numbers::pi * inner / 8, 0.004 * lap.time);
  EXPECT_NEAR(std::hypot(lap.states[9][X], lap.states[9][Y]), beside, 0.1);
}

TEST(Lap, ARoadThatHasNoLapOrNoRoomIsRefused) {
  const world::Road open({{0, 0, 4, 4}, {50, 0, 4, 4}, {100, 0, 4, 4}}, false, {}, "open");
  EXPECT_THROW(fastest_lap(open, body()), InvalidValue);
  EXPECT_THROW(fastest_lap(*oval(100, 60, 0.9), body()), InvalidValue);
}

TEST(LinePlanner, WantsARoad) {
  Task task;
  task.planner.method = Method::along_road;
  EXPECT_THROW(Planner{task}, InvalidValue);
}

TEST(LinePlanner, DrivesOffFromRest) {
  const Task task = by_P_L();
  Planner planner(task);
  const Plant plant(task.vehicle, 1e-9, 0.02);
  const auto place = task.road->at(0);
  State x{place.x, place.y, 0, 0, place.psi, 0, 0, 0};
  for (double t = 0; t < 2; t += 0.1) {
    Request request;
    request.X0p = x;
    request.t0 = t - 0.1;
    request.t_start = t;
    const Plan plan = planner.plan(request);
    ASSERT_TRUE(plan.report.solved) << plan.report.status_text() << " at " << t;
    x = plant.predict(x, control_signal(plan), t, t + 0.1);
  }
  EXPECT_GT(x[UX], 2);
}

TEST(LinePlanner, DrivesALapInClosedLoopNearlyAsFastAndOnTheRoad) {
  const Task task = by_P_L();
  Planner planner(task);
  const Plant plant(task.vehicle, 1e-9, 0.02);
  const world::Footprint footprint(task.vehicle);
  const auto place = task.road->at(0);
  State x{place.x, place.y, 0, 0, place.psi, 0, 10, 0};
  double t = 0, driven = 0, s = 0, begun = 0, least = INFINITY;
  const double tex = 0.1, length = task.road->length();
  for (int laps = 0; laps < 2 && t < 120;) {
    Request request;
    request.X0p = x;
    request.t0 = t - tex;
    request.t_start = t;
    const Plan plan = planner.plan(request);
    ASSERT_TRUE(plan.report.solved) << plan.report.status_text() << " at " << s;
    x = plant.predict(x, control_signal(plan), t, t + tex);
    t += tex;
    least = std::min(least, footprint.edge_distance(*task.road, x));
    const double now = task.road->project({x[X], x[Y]}, s).s;
    driven += std::remainder(now - s, length);
    s = now;
    if (driven < (laps + 1) * length) continue;
    if (++laps == 1) begun = t;
  }
  EXPECT_GT(least, 0);
  const double best = fastest_lap(*task.road, task.vehicle, {.interval = 5}).time;
  EXPECT_LT(t - begun, 1.03 * best + tex);
  EXPECT_GT(t - begun, best - tex);
}

/// The nearest that a plan's body comes to the edges of its road [m].
double edge_distance(const Task& task, const Plan& plan) {
  const world::Footprint footprint(task.vehicle);
  double least = INFINITY;
  for (const State& x : plan.states)
    least = std::min(least, footprint.edge_distance(*task.road, x));
  return least;
}

TEST(LinePlanner, KeepsItsMarginFromTheEdges) {
  Scene scene = by_P_L();
  for (const double margin : {0.1, 1.2}) {
    scene.planner.road_margin = margin;
    const Plan plan = Planner(scene).plan(scene.first);
    ASSERT_TRUE(plan.report.solved) << plan.report.status_text();
    EXPECT_NEAR(edge_distance(scene, plan), margin, 0.05) << "it uses what is left of the road";
  }
}

TEST(Lap, AnIntervalThatMakesNoMeshIsRefused) {
  const auto road = oval(60, 40, 6);
  for (const double interval : {0.0, -6.0, 1e-9, std::nan(""), HUGE_VAL}) {
    LapSettings settings;
    settings.interval = interval;
    EXPECT_THROW((void)fastest_lap(*road, body(), settings), InvalidValue) << interval;
  }
}

}  // namespace
}  // namespace slalom::planner
