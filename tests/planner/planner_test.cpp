#include "slalom/planner/planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/expect_plan.hpp"
#include "planner/scenes.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

TEST(Planner, FirstPlansAreSolvedByEveryBackEnd) {
  for (const auto solver : solvers())
    for (auto scene : {E_A(), E_B(), E_C()}) {
      scene.planner.solver = solver;
      const Plan plan = Planner(scene).plan(scene.first);
      SCOPED_TRACE(plan.report.backend);
      expect_solved(plan);
      EXPECT_FALSE(plan.goal_in_range);
      EXPECT_EQ(plan.t_start, 0.5);
      ASSERT_EQ(plan.t.size(), static_cast<std::size_t>(scene.planner.N) + 1);
      EXPECT_EQ(plan.states.size(), plan.t.size());
      EXPECT_EQ(plan.controls.size(), plan.t.size());
      EXPECT_EQ(plan.t.front(), 0);
      EXPECT_EQ(plan.t.back(), plan.tf);
      EXPECT_GT(least_obstacle_row(scene, plan), 0);
      double sum = 0;
      for (const auto& [name, value] : plan.report.cost_terms) sum += value;
      EXPECT_NEAR(sum, plan.report.cost, 1e-9 * std::fabs(plan.report.cost));
      for (const auto& state : plan.states) {
        EXPECT_GT(state[X], scene.region.x_min);
        EXPECT_LT(state[X], scene.region.x_max);
      }
    }
}

TEST(Planner, SoftObstaclesCostWhatTheyAreEnteredBy) {
  for (const auto scheme : {SchemeChoice::trapezoidal, SchemeChoice::backward_euler}) {
    auto scene = E_B();
    scene.planner.scheme = scheme;
    scene.planner.N = 40;
    scene.planner.floor = 0;
    scene.obstacles = {scene.obstacles[0]};  // stands in the way
    scene.obstacles[0].x = 200.5;
    scene.obstacles[0].y = 40;
    scene.obstacles[0].vx = scene.obstacles[0].vy = 0;
    const Plan hard = Planner(scene).plan(scene.first);
    scene.planner.obstacle_constraint = ObstacleConstraint::soft;
    scene.planner.w_obstacle = 1e5;
    const Plan dear = Planner(scene).plan(scene.first);
    scene.planner.w_obstacle = 0.01;
    const Plan cheap = Planner(scene).plan(scene.first);
    ASSERT_TRUE(hard.report.solved && dear.report.solved && cheap.report.solved);
    EXPECT_NEAR(dear.report.cost, hard.report.cost, 1e-3) << "an exact penalty";
    EXPECT_GT(least_obstacle_row(scene, hard), -1e-6);
    EXPECT_GT(least_obstacle_row(scene, dear), -1e-4);
    EXPECT_LT(least_obstacle_row(scene, cheap), -0.1);
    EXPECT_LT(cheap.report.cost, hard.report.cost - 0.01);
  }
}

TEST(Planner, ALowFloorIsReachedFromAColdStart) {
  // Restoration ends at a point higher than those before it; what the filter knows of these must
  // not hold the search up. (54 iterations at most; held up, most of these take hundreds.)
  for (const double x : {199.5, 199.6, 199.7, 199.8, 199.9, 200.0, 200.1}) {
    auto scene = E_A();
    scene.planner.w_t = 0;
    scene.planner.floor = 0.1;
    scene.first.X0p[X] = x;
    const Plan plan = Planner(scene).plan(scene.first);
    SCOPED_TRACE(x);
    expect_solved(plan);
    EXPECT_LE(plan.report.iterations, 100);
  }
}

TEST(Planner, AgreesWithThePublishedFirstOcp) {
  const Plan plan = Planner(E_A()).plan(E_A().first);
  EXPECT_NEAR(plan.report.phi, -157.7753, 1e-3);  // stationary at the central point
  EXPECT_NEAR(plan.tf, 2.515208, 2e-3);
  EXPECT_NEAR(plan.states.back()[X], 196.49608, 0.02);
  EXPECT_NEAR(plan.states.back()[Y], 53.46048, 0.02);
}

TEST(Planner, StaysSolvedAndWarmAcrossTheSwitchIntoRange) {
  for (const auto solver : solvers())
    for (auto scene : {E_A(), E_B()}) {
      scene.planner.solver = solver;
      auto planner = Planner(scene);
      Request request = scene.first;
      int switches = 0, warm = 0, cold = 0;
      bool was_in_range = false;
      for (int cycle = 0; cycle < 10; ++cycle) {
        const Plan plan = planner.plan(request);
        SCOPED_TRACE(plan.report.backend + ", cycle " + std::to_string(cycle));
        expect_solved(plan);
        if (!plan.report.solved) return;
        const double to_go =
            std::hypot(request.X0p[X] - scene.goal.x, request.X0p[Y] - scene.goal.y);
        EXPECT_EQ(plan.goal_in_range, to_go < scene.planner.L_range);
        switches += plan.goal_in_range != was_in_range ? 1 : 0;
        was_in_range = plan.goal_in_range;
        if (plan.goal_in_range) {
          EXPECT_LT(std::fabs(plan.states.back()[X] - scene.goal.x), scene.planner.XF_tol);
          EXPECT_LT(std::fabs(plan.states.back()[Y] - scene.goal.y), scene.planner.XF_tol);
        } else {
          const double reach = std::hypot(plan.states.back()[X] - plan.states.front()[X],
                                          plan.states.back()[Y] - plan.states.front()[Y]);
          EXPECT_GT(reach, scene.planner.L_range - scene.planner.kappa);
          EXPECT_LT(reach, scene.planner.L_range + scene.planner.kappa);
        }
        EXPECT_GT(least_obstacle_row(scene, plan), 0);
        if (cycle > 0) {
          warm += plan.report.iterations;
          cold += Planner(scene).plan(request).report.iterations;
        }
        request = next_cycle(request, plan);
        if (std::hypot(request.X0p[X] - scene.goal.x, request.X0p[Y] - scene.goal.y) < 15) break;
      }
      EXPECT_EQ(switches, 1);
      EXPECT_LT(warm, cold) << "iterations with and without the last plan";
    }
}

TEST(Planner, AGoalIsNotMetHalfATurnOff) {
  Scene scene = E_B();
  scene.obstacles.clear();
  scene.goal = {scene.first.X0p[X], scene.first.X0p[Y] + 35, scene.first.X0p[PSI] + 0.9 * M_PI, 5};
  const auto price = [&](double turned) {
    Scene turned_goal = scene;
    turned_goal.goal.psi += turned;
    turned_goal.goal.psi_tolerance = 0.2;
    return Planner(turned_goal).plan(turned_goal.first).report.cost;
  };
  EXPECT_GT(price(0), price(-0.9 * M_PI) + 1000);
}

TEST(Planner, HeldObstaclesStandWhereTheyAreAtPlanning) {
  Scene held = E_B();
  held.planner.moving_avoidance = false;
  held.first.t0 = 0.75;
  held.first.t_start = 1.25;
  const Plan plan = Planner(held).plan(held.first);
  expect_solved(plan);
  EXPECT_EQ(plan.obstacle_time_held, 0.75);

  Scene standing = held;
  for (auto& o : standing.obstacles) o = {o.name, o.x_at(0.75), o.y_at(0.75), o.a, o.b, 0, 0};
  expect_same(plan, Planner(standing).plan(held.first));

  Scene moving = held;
  moving.planner.moving_avoidance = true;
  const Plan other = Planner(moving).plan(held.first);
  expect_solved(other);
  EXPECT_FALSE(other.obstacle_time_held);
  EXPECT_GT(least_obstacle_row(moving, other), 0) << "clear of them where they will be";
  EXPECT_GT(distance(plan, other, [](const State& s) { return std::pair{s[X], s[Y]}; }), 1);
}

/// An obstacle's motion is given in absolute time, and node 0 is at t_start.
TEST(Planner, MovingObstaclesAreMetInAbsoluteTime) {
  Scene early = E_B(), late = E_B();
  late.first.t0 = 20;
  late.first.t_start = 20.5;
  for (auto& o : late.obstacles) {
    o.x -= 20 * o.vx;
    o.y -= 20 * o.vy;
  }
  const Plan a = Planner(early).plan(early.first), b = Planner(late).plan(late.first);
  EXPECT_EQ(b.t_start, 20.5);
  EXPECT_LT(distance(a, b, [](const State& s) { return std::pair{s[X], s[Y]}; }), 1e-6);
}

/// Obstacles measured in a cycle take the place of those the planner was made with, and only there.
TEST(Planner, MeasuredObstaclesAreThoseOfTheirCycleAlone) {
  Scene scene = E_B(), elsewhere = E_B();
  for (auto& o : elsewhere.obstacles) o = {o.name, o.x + 40, o.y - 30, o.a, o.b, 1, 1};
  const Plan expected = Planner(scene).plan(scene.first);

  Planner planner = Planner(elsewhere);
  std::vector<Recording> recordings;
  planner.record({[](const SolveReport&) { return true; },
                  [&](const Recording& r) { recordings.push_back(r); }});
  Request measured = elsewhere.first;
  measured.obstacles = scene.obstacles;
  expect_same(planner.plan(measured), expected);
  planner.reset();
  expect_same(planner.plan(elsewhere.first), Planner(elsewhere).plan(elsewhere.first));
  ASSERT_EQ(recordings.size(), 2u);
  for (const auto& r : recordings) EXPECT_TRUE(replay(r, elsewhere).same);
}

TEST(Planner, MovedSceneGivesTheMovedPlan) {
  for (const auto& scene : {E_A(), E_B(), E_C()}) {
    const double dx = 10e3, dy = 7e3;
    const Scene elsewhere = moved(scene, dx, dy);
    auto here = Planner(scene), there = Planner(elsewhere);
    Request request = scene.first, request_there = elsewhere.first;
    for (int cycle = 0; cycle < 3; ++cycle) {
      const Plan plan = here.plan(request), other = there.plan(request_there);
      expect_solved(other);
      EXPECT_LT(distance(plan, other,
                         [=](const State& s) {
                           return std::pair{s[X] - dx, s[Y] - dy};
                         }),
                0.01)
          << "cycle " << cycle;
      request = next_cycle(request, plan);
      request_there = next_cycle(request_there, other);
    }
  }
}

TEST(Planner, MirroredSceneGivesTheMirroredPlan) {
  for (auto scene : {E_A(), E_B()}) {
    scene.vehicle.tyre_asymmetry = false;
    scene.first.X0p = {200, 8.5, 0.1, 0.02, 1.5, 0.01, 17, 0.2};
    Scene mirrored = scene;
    const auto mirror = [](double x) { return 400 - x; };
    for (auto& o : mirrored.obstacles) {
      o.x = mirror(o.x);
      o.vx = -o.vx;
    }
    mirrored.goal.x = mirror(scene.goal.x);
    mirrored.goal.psi = std::numbers::pi - scene.goal.psi;
    State& s = mirrored.first.X0p;
    s[X] = mirror(s[X]);
    s[PSI] = std::numbers::pi - s[PSI];
    for (auto i : {V, R, SA}) s[i] = -s[i];
    const Plan plan = Planner(scene).plan(scene.first);
    const Plan other = Planner(mirrored).plan(mirrored.first);
    expect_solved(plan);
    expect_solved(other);
    EXPECT_NEAR(plan.tf, other.tf, 1e-4);
    EXPECT_LT(distance(plan, other,
                       [&](const State& state) {
                         return std::pair{mirror(state[X]), state[Y]};
                       }),
              0.01);
  }
}

TEST(Planner, HermiteSimpsonSolvesToo) {
  for (const auto solver : solvers())
    for (auto scene : {E_A(), E_C()}) {
      scene.planner.solver = solver;
      scene.planner.scheme = SchemeChoice::hermite_simpson;
      const Plan plan = Planner(scene).plan(scene.first);
      expect_solved(plan);
      EXPECT_EQ(plan.t.size(), 2 * static_cast<std::size_t>(scene.planner.N) + 1)
          << "with the intervals' midpoints";
      EXPECT_GT(least_obstacle_row(scene, plan), 0);
    }
}

/// The plan's controls through another model and another integrator. Ten or fifteen intervals are
/// coarse: this bounds what a plan may promise, not what the plant does. Hermite-Simpson's controls
/// are quadratic over an interval; taken as linear between its points they miss by more.
TEST(Planner, ReplayedPlansEndNearTheirLastNode) {
  for (auto scene : {E_A(), E_B(), E_C()})
    for (const bool coarse : {true, false}) {
      scene.planner.scheme = coarse ? SchemeChoice::trapezoidal : SchemeChoice::hermite_simpson;
      const Plan plan = Planner(scene).plan(scene.first);
      const State end = integrate(plan, plan.tf, coarse ? Controls::linear : Controls::quadratic);
      const State& last = plan.states.back();
      EXPECT_LT(std::hypot(end[X] - last[X], end[Y] - last[Y]), coarse ? 0.6 : 0.15);
      EXPECT_NEAR(end[PSI], last[PSI], coarse ? 0.05 : 0.02);
      EXPECT_NEAR(end[UX], last[UX], coarse ? 0.05 : 1e-5);
    }
}

TEST(Planner, ResetForgetsTheLastPlan) {
  const Scene scene = E_A();
  auto planner = Planner(scene);
  const Plan first = planner.plan(scene.first);
  const Plan again = planner.plan(scene.first);
  EXPECT_LT(again.report.iterations, first.report.iterations) << "warm";
  planner.reset();
  expect_same(planner.plan(scene.first), first);
}

TEST(Planner, APlanIsAsLongAsItMustBe) {
  Scene scene = E_A();
  const Plan plan = Planner(scene).plan(scene.first);
  expect_solved(plan);
  scene.planner.tf_min = plan.tf + 0.5;
  const Plan longer = Planner(scene).plan(scene.first);
  expect_solved(longer);
  EXPECT_NEAR(longer.tf, scene.planner.tf_min, 0.1);
  EXPECT_GE(longer.tf, scene.planner.tf_min);
}

TEST(Planner, SolvesWithoutObstacles) {
  Scene scene = E_A();
  scene.obstacles.clear();
  expect_solved(Planner(scene).plan(scene.first));
}

/// 40 m from rest at 2.1 m/s^2 take 6.19 s; P_A, which has no weight on time, takes longer.
TEST(Planner, AStartFromRestIsSolvedByPlannersAToD) {
  struct Differences {
    double w_t, w_ce;
    bool moving_avoidance;
  };
  for (const Differences& d :
       {Differences{0, 0, false}, {100, 0, false}, {100, 1, false}, {100, 1, true}})
    for (const double ux : {0., 0.01})
      for (const auto& [goal, y] : {std::pair(40., 0.), {49., 0.5}, {50., 0.5}}) {
        SCOPED_TRACE(testing::Message() << d.w_t << ' ' << d.w_ce << ' ' << ux << ' ' << goal);
        Scene scene;
        scene.planner.w_t = d.w_t;
        scene.planner.w_ce = d.w_ce;
        scene.planner.moving_avoidance = d.moving_avoidance;
        scene.vehicle.ux_max = 20;
        scene.goal = {.x = goal, .y = 0, .psi = 0, .sigma = 2};
        scene.first = {{0, y, 0, 0, 0, 0, ux, 0}, 0, 0.5};
        const Plan plan = Planner(scene).plan(scene.first);
        expect_solved(plan);
        if (goal == 40 && d.w_t > 0) EXPECT_NEAR(plan.tf, 6.19, 0.02);
      }
}

TEST(Planner, WithoutAFloorItSolvesToTheOptimum) {
  Scene scene = E_A();
  scene.planner.floor = 0;
  const Plan plan = Planner(scene).plan(scene.first);
  EXPECT_TRUE(plan.report.solved) << plan.report.status_text();
  EXPECT_LT(plan.report.cost, 271.6379 - 1) << "the barrier's distance from the limits is gone";
  EXPECT_LE(plan.report.worst_violation, 1e-6);
}

TEST(Planner, WithoutAFloorAWarmSolveTakesFewIterations) {
  // The median is 15 with predictor and corrector, 19 without them.
  Scene scene = E_C();
  scene.planner.floor = 0;
  auto planner = Planner(scene);
  Request request = scene.first;
  request.t_start = request.t0 + 0.1;
  std::vector<int> iterations;
  for (int cycle = 0; cycle < 12; ++cycle) {
    const Plan plan = planner.plan(request);
    ASSERT_TRUE(plan.report.solved) << plan.report.status_text();
    if (cycle > 0) iterations.push_back(plan.report.iterations);
    request = next_cycle(request, plan);
  }
  std::sort(iterations.begin(), iterations.end());
  EXPECT_LE(iterations[iterations.size() / 2], 16);
}

}  // namespace
}  // namespace slalom::planner
