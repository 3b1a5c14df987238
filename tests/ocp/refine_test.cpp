// Meshes refined until re-integration confirms the tolerance; one test for each way it ends.

#include "slalom/ocp/refine.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

/// x' = -x^3 + u over a long time, of which only both ends matter (Rao & Mease 2000).
Problem hyper_sensitive(double tf) {
  Problem p("hyper-sensitive");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u - x * x * x);
  p.lagrange("cost", (square(x) + square(u)) / 2);
  p.final_time(Bounds::equal(tf), tf);
  fix(p, x, 1, 1.5);
  return p;
}

TEST(Refinement, ReachesTheToleranceByEverySchemeAndBothWays) {
  const auto form = brachistochrone();
  const auto reach = [&](const Scheme& scheme, Refinement refinement) {
    const Refined refined =
        refine(form.problem, {.mesh = Mesh::uniform(2), .scheme = scheme, .guess = form.guess},
               {.tolerance = 1e-6, .refinement = refinement});
    SCOPED_TRACE(scheme.name + "\n" + refined.table());
    EXPECT_EQ(refined.status, RefineStatus::converged);
    EXPECT_LE(estimate_errors(form.problem, refined.solution).largest, 1e-6);
    EXPECT_NEAR(refined.solution.objective, form.objective, 1e-5);
    EXPECT_GT(refined.meshes.size(), 1U);
    EXPECT_EQ(refined.meshes.back().intervals, refined.solution.mesh.intervals());
  };
  for (const Scheme& scheme : {trapezoidal(), hermite_simpson(), lgr(2), lgl(3)})
    reach(scheme, Refinement::h);
  for (const Scheme& scheme : {lgr(2), lgr_differential(2), lgl(3)}) reach(scheme, Refinement::hp);
}

TEST(Refinement, PutsPointsWhereTheSolutionIsFastAndStartsFromTheLastMesh) {
  const SolveSettings start{.mesh = Mesh::uniform(20), .scheme = lgr(3)};
  const Problem problem = hyper_sensitive(100);
  const Refined refined = refine(problem, start, {.tolerance = 1e-6});
  SCOPED_TRACE(refined.table());
  ASSERT_EQ(refined.status, RefineStatus::converged);
  // Both ends take as long as 10 of the 100; the middle needs none of the new intervals.
  const auto& breaks = refined.solution.mesh.breakpoints();
  std::size_t middle = 0;
  for (const double b : breaks) middle += b > 0.21 && b < 0.79 ? 1 : 0;
  EXPECT_LT(3 * middle, breaks.size());
  SolveSettings cold = start;
  cold.mesh = refined.solution.mesh;
  cold.scheme = refined.solution.scheme;
  const Solution anew = solve(problem, cold);
  ASSERT_TRUE(anew.solved());
  EXPECT_NEAR(anew.objective, refined.solution.objective, 1e-6);
  EXPECT_LT(refined.meshes.back().iterations, anew.iterations);
}

TEST(Refinement, FindsTheCostOfControlsThatJumpAndBend) {
  for (const auto& form : {moon_lander(), bryson_denham(1.0 / 9)})
    for (const Scheme& scheme : {hermite_simpson(), lgr(4), lgl(4)}) {
      const SolveSettings start{.mesh = Mesh::uniform(20), .scheme = scheme};
      const Refined refined = refine(form.problem, start);
      SCOPED_TRACE(form.name + " by " + scheme.name + "\n" + refined.table());
      EXPECT_EQ(refined.status, RefineStatus::converged);
      EXPECT_NEAR(refined.solution.objective / form.objective, 1, 2e-6);
      const Refined careless = refine(form.problem, start, {.resolve_controls = false});
      EXPECT_EQ(careless.meshes.size(), 1U) << "its states are exact at once";
      EXPECT_GT(std::fabs(careless.solution.objective / form.objective - 1), 2e-6);
    }
}

TEST(Refinement, EndsAtItsLimitsAndSaysSo) {
  const auto form = least_time();  // u jumps: no mesh without a node at the jump is exact
  RefineRules rules{.tolerance = 1e-12, .max_meshes = 1};
  const auto fall = brachistochrone();
  SolveSettings start{.mesh = Mesh::uniform(5), .guess = fall.guess};
  Refined refined = refine(fall.problem, start, rules);
  EXPECT_EQ(refined.status, RefineStatus::mesh_limit);
  EXPECT_EQ(refined.meshes.size(), 1U);
  EXPECT_GT(refined.errors.largest, 1e-12);
  rules.max_meshes = 15;
  rules.max_size = 100;
  refined = refine(fall.problem, start, rules);
  EXPECT_EQ(refined.status, RefineStatus::size_limit);
  EXPECT_LE(refined.solution.trajectory.tau.size(), 100U);

  start = {};
  start.options.max_iterations = 1;
  refined = refine(form.problem, start);
  EXPECT_EQ(refined.status, RefineStatus::not_solved);
  EXPECT_EQ(refined.meshes.back().status, nlp::Status::iteration_limit);
  EXPECT_NE(refined.table().find("not_solved"), std::string::npos);
}

TEST(Refinement, RefusesSettingsThatCannotBe) {
  const auto form = regulator();
  RefineRules rules{.refinement = Refinement::hp};
  EXPECT_EQ(refusal([&] { (void)refine(form.problem, {}, rules); }),
            "linear regulator: refinement: hp: found the scheme hermite_simpson, expected lgr, "
            "lgr_differential or lgl, which have degrees");
  rules = {};
  rules.tolerance = std::nan("");
  EXPECT_EQ(refusal([&] { (void)refine(form.problem, {}, rules); }),
            "linear regulator: refinement: tolerance: found nan, expected a number > 0 and < 1");
  rules = {};
  rules.max_points = 2;
  EXPECT_EQ(refusal([&] { (void)refine(form.problem, {}, rules); }),
            "linear regulator: refinement: max_points: found 2, expected at least 3");
}

}  // namespace
}  // namespace slalom::ocp
