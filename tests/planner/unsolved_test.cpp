// Plans that are not solved: what they say, and what the next one starts from.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "planner/expect_plan.hpp"
#include "planner/line_scenes.hpp"
#include "planner/scenes.hpp"

namespace slalom::planner {
namespace {

/// A ring of obstacles too thick to be stepped over between two nodes, that drives off at once.
Scene ring() {
  Scene scene = E_A();
  scene.planner.max_iterations = 120;
  scene.obstacles.clear();
  for (int i = 0; i < 16; ++i) {
    const double angle = 2 * std::numbers::pi * i / 16;
    scene.obstacles.push_back({"R" + std::to_string(i), 200 + 30 * std::cos(angle),
                               8.5 + 30 * std::sin(angle), 16, 16, 1000, 0});
  }
  return scene;
}

TEST(Unsolved, AnImpossiblePlanIsNeitherSolvedNorDrivenAndSaysWhy) {
  for (const auto solver : solvers()) {
    Scene scene = ring();
    scene.planner.solver = solver;
    scene.first.best_iterate_tol = 1e-3;
    const Plan plan = Planner(scene).plan(scene.first);
    SCOPED_TRACE(plan.report.backend + ": " + plan.report.status_text());
    EXPECT_FALSE(plan.report.solved);
    EXPECT_FALSE(plan.report.best_iterate);
    EXPECT_NE(plan.report.status, PlanStatus::solved);
    EXPECT_GT(plan.report.worst_violation, 1e-3);
    EXPECT_FALSE(plan.report.worst_constraint.empty());
    EXPECT_EQ(plan.states.size(), 11u) << "the last iterate is returned";
  }
}

/// Parked cars block the road. What is said to be in the way says by how much, and that is true: by
/// that margin there is a plan.
TEST(Unsolved, TheMarginThatWouldDoDoes) {
  Scene scene;
  scene.vehicle.ux_max = 15;
  scene.goal = {.x = 200, .y = 0, .psi = 0, .sigma = 10};
  scene.region.y_min = -6;
  scene.region.y_max = 6;
  for (int k = 0; k < 4; ++k)
    scene.obstacles.push_back({"wall" + std::to_string(k + 1), 100, -6 + 4. * k, 2, 2, 0, 0});
  scene.first = {{50, 0, 0, 0, 0, 0, 12, 0}, 3.5, 4};
  const auto as_stated = scene.planner;
  for (const auto scheme : {SchemeChoice::trapezoidal, SchemeChoice::hermite_simpson}) {
    scene.planner = as_stated;
    scene.planner.scheme = scheme;
    const Plan refused = Planner(scene).plan(scene.first);
    ASSERT_EQ(refused.report.status, PlanStatus::infeasible);
    const std::string& blocks = refused.report.blocks;
    double wanted = 0, would_do = 0;
    ASSERT_EQ(
        std::sscanf(blocks.c_str(),
                    "wall%*d in the way: node %*d of the plan comes to %*f m from its edge, where "
                    "a margin of %lf m is kept and %lf m would do",
                    &wanted, &would_do),
        2)
        << blocks;
    EXPECT_EQ(wanted, scene.planner.sm_end);
    scene.planner.sm_end = would_do;
    scene.planner.sm_start = std::min(scene.planner.sm_start, would_do);
    const Plan plan = Planner(scene).plan(scene.first);
    EXPECT_TRUE(plan.report.solved) << plan.report.status_text() << ", " << plan.report.blocks;
  }
}

TEST(Unsolved, AFailedPlanIsNoStartForTheNext) {
  for (const auto solver : solvers()) {
    SCOPED_TRACE(to_string(solver));
    Scene scene = ring();
    scene.planner.solver = solver;
    Request away = scene.first, later = scene.first;
    away.t0 = 100;  // the ring has gone
    away.t_start = 100.5;
    later.t0 = 100.5;
    later.t_start = 101;
    auto failed_first = Planner(scene), fresh = Planner(scene);
    ASSERT_FALSE(failed_first.plan(scene.first).report.solved);
    const Plan expected = fresh.plan(away);
    expect_solved(expected);
    expect_same(failed_first.plan(away), expected);

    ASSERT_FALSE(failed_first.plan(scene.first).report.solved);
    expect_same(failed_first.plan(later), fresh.plan(later));
  }
}

/// The solver met a point that meets all rows before it was cut off; a plan within the tolerance is
/// one to be driven, and the next solve starts from it.
TEST(Unsolved, ABestIterateWithinTheToleranceIsAStartForTheNext) {
  for (const auto solver : solvers()) {
    SCOPED_TRACE(to_string(solver));
    Scene scene = E_A(), cut = scene;
    scene.planner.solver = cut.planner.solver = solver;
    const int needed = Planner(scene).plan(scene.first).report.iterations;
    cut.planner.max_iterations = needed - 1;
    const Plan refused = Planner(cut).plan(cut.first);
    ASSERT_EQ(refused.report.status, PlanStatus::iteration_limit);
    EXPECT_FALSE(refused.report.best_iterate) << "none is asked for";

    const double violation = refused.report.worst_violation;
    ASSERT_LT(violation, 0.1);
    for (const bool good_enough : {true, false}) {
      cut.first.best_iterate_tol = good_enough ? violation : violation / 2 - 1e-12;
      auto planner = Planner(cut), fresh = Planner(cut);
      const Plan plan = planner.plan(cut.first);
      EXPECT_EQ(plan.report.status, PlanStatus::iteration_limit);
      EXPECT_FALSE(plan.report.solved);
      EXPECT_EQ(plan.report.best_iterate, good_enough);
      const Plan next = planner.plan(cut.first), from_nothing = fresh.plan(cut.first);
      EXPECT_EQ(next.report.solved, good_enough) << "a start within the few iterations left";
      EXPECT_EQ(from_nothing.report.solved, false);
    }
  }
}

TEST(Unsolved, ASolveCutShortGoesOnInTheNextCycle) {
  for (const auto solver : solvers()) {
    SCOPED_TRACE(to_string(solver));
    Scene scene = E_A();
    scene.planner.solver = solver;
    const int needed = Planner(scene).plan(scene.first).report.iterations;
    Request cut = scene.first;
    int left = needed * 4 / 5;
    cut.interrupted = [&left] { return --left < 0; };
    auto planner = Planner(scene);
    EXPECT_EQ(planner.plan(cut).report.status, PlanStatus::interrupted);
    const Plan next = planner.plan(scene.first);
    expect_solved(next);
    EXPECT_LT(next.report.iterations, needed * 3 / 4);
  }
}

// P_L tries other guesses where a solve fails. What they come to takes the place of nothing better.

/// What all guesses of a first plan come to.
std::vector<SolveReport> reports_of(const Scene& scene) {
  std::vector<SolveReport> reports;
  Planner planner(scene);
  planner.record({[&](const SolveReport& report) {
                    reports.push_back(report);
                    return false;
                  },
                  [](const Recording&) {}});
  (void)planner.plan(scene.first);
  return reports;
}

TEST(UnsolvedAlongRoad, ABestIterateWithinTheToleranceIsDrivenAndAStartForTheNext) {
  Scene cut = by_P_L();
  std::vector<SolveReport> reports = reports_of(cut);
  ASSERT_EQ(reports.size(), 1u);
  cut.planner.max_iterations = reports[0].iterations;
  do {  // so few iterations that no guess is solved
    ASSERT_GT(--cut.planner.max_iterations, 3);
    reports = reports_of(cut);
  } while (reports.back().solved);
  ASSERT_EQ(reports.size(), 2u);
  ASSERT_NE(reports[0].worst_violation, reports[1].worst_violation);

  Planner refusing(cut);
  const Plan refused = refusing.plan(cut.first);
  EXPECT_FALSE(refused.report.best_iterate) << "none is asked for";
  expect_same(refusing.plan(cut.first), refused);

  cut.first.best_iterate_tol = 1e6;
  Planner planner(cut);
  const Plan plan = planner.plan(cut.first);
  EXPECT_FALSE(plan.report.solved);
  EXPECT_TRUE(plan.report.best_iterate);
  EXPECT_EQ(plan.report.worst_violation, reports[0].worst_violation) << "the first, not the last";
  EXPECT_LT(planner.plan(cut.first).report.worst_violation, reports[0].worst_violation)
      << "it goes on from there";
}

TEST(UnsolvedAlongRoad, ASolveCutShortIsTheLastOfItsCycleAndGoesOnInTheNext) {
  const Scene scene = by_P_L();
  const Plan whole = Planner(scene).plan(scene.first);
  const int needed = whole.report.iterations;
  Planner planner(scene);
  int solves = 0;
  planner.record({[](const SolveReport&) { return true; }, [&](const Recording&) { ++solves; }});
  Request cut = scene.first;
  int left = needed * 4 / 5;
  cut.interrupted = [&left] { return --left < 0; };
  const Plan plan = planner.plan(cut);
  EXPECT_EQ(plan.report.status, PlanStatus::interrupted);
  EXPECT_GT(plan.report.iterations, needed / 2) << "its own iterate, not that of a new guess";
  EXPECT_EQ(solves, 1);
  const Plan next = planner.plan(scene.first);
  EXPECT_TRUE(next.report.solved);
  EXPECT_LT(next.report.iterations, needed * 3 / 4);
}

TEST(UnsolvedAlongRoad, AFailedPlanLeavesTheLastOneForTheNext) {
  Scene scene = by_P_L();
  Planner failed(scene), fresh(scene);
  expect_same(failed.plan(scene.first), fresh.plan(scene.first));
  Request off = scene.first;  // far off the road
  off.X0p[vehicle::X] += 60;
  ASSERT_FALSE(failed.plan(off).report.solved);
  expect_same(failed.plan(scene.first), fresh.plan(scene.first));
}

TEST(Unsolved, TimeLimitEndsASolve) {
  for (const auto solver : solvers()) {
    Scene scene = E_C();
    scene.planner.solver = solver;
    scene.first.time_limit = 1e-6;
    const Plan plan = Planner(scene).plan(scene.first);
    EXPECT_FALSE(plan.report.solved);
    EXPECT_EQ(plan.report.status, PlanStatus::time_limit);
    EXPECT_GE(plan.report.planning_cpu_s, plan.report.cpu_s);
  }
}

}  // namespace
}  // namespace slalom::planner
