// Meshes refined until re-integration confirms the tolerance; one test for each way it ends.

#include "slalom/ocp/refine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"
#include "slalom/base/timer.hpp"

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
  for (const Scheme& scheme : {lgr(2), lgr_differential(2), lgr_flipped(2), lgl(3)})
    reach(scheme, Refinement::hp);
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

/// Whether more iterations were done than there may be.
struct Count {
  int done = 0, most = 0;
  void put(nlp::Options& options) {
    options.on_iteration = [](const nlp::IterationInfo&, void* data) {
      ++static_cast<Count*>(data)->done;
    };
    options.stop = [](void* data) {
      const auto& count = *static_cast<Count*>(data);
      return count.done > count.most;
    };
    options.on_iteration_data = options.stop_data = this;
  }
};

TEST(Refinement, KeepsTheLastAnswerWhereItIsStopped) {
  const auto fall = brachistochrone();
  SolveSettings start{.mesh = Mesh::uniform(5), .guess = fall.guess};
  const Refined whole = refine(fall.problem, start);
  ASSERT_GT(whole.meshes.size(), 1U);
  Count count{.most = whole.meshes.front().iterations};
  count.put(start.options);
  const Refined refined = refine(fall.problem, start);
  EXPECT_STREQ(to_string(refined.status), "stopped") << refined.table();
  ASSERT_EQ(refined.meshes.size(), 2U);
  EXPECT_EQ(refined.meshes.back().status, nlp::Status::interrupted);
  EXPECT_LE(count.done, count.most + 1) << "it was not solved again";
  EXPECT_TRUE(refined.solution.solved());
  EXPECT_EQ(refined.solution.mesh.intervals(), 5U);
  EXPECT_EQ(refined.errors.interval.size(), 5U);
}

TEST(Refinement, HasOneTimeLimitForAllMeshes) {
  const auto fall = brachistochrone();
  SolveSettings start{.mesh = Mesh::uniform(2), .scheme = lgr(2), .guess = fall.guess};
  start.options.time_limit = 0.3;
  const Timer timer;
  const Refined refined =
      refine(fall.problem, start, {.tolerance = 1e-30, .max_meshes = 1000, .max_size = 1000000});
  EXPECT_LT(timer.wall(), 10);  // on a machine with much else to do
  EXPECT_EQ(refined.solution.options.time_limit, 0.3);
  // How many meshes that is, and whether the last was solved and not judged, depends on the
  // machine.
  const MeshRecord& last = refined.meshes.back();
  const bool solved = last.status == nlp::Status::solved;
  EXPECT_TRUE(solved ? std::isinf(last.largest_error) : last.status == nlp::Status::time_limit)
      << refined.table();
  const bool any = solved || refined.meshes.size() > 1;
  EXPECT_EQ(refined.status, any ? RefineStatus::stopped : RefineStatus::not_solved);
  EXPECT_EQ(refined.solution.solved(), any);
}

/// A warm start is the first mesh's alone, in a second try of a later mesh too.
TEST(Refinement, ForgetsTheWarmStartAfterTheFirstMesh) {
  const Problem problem = hyper_sensitive(100);
  SolveSettings start{.mesh = Mesh::uniform(20), .scheme = lgr(3)};
  start.warm_start = solve(problem, start).point;
  start.options.max_iterations = solve(problem, start).iterations;
  const Refined refined = refine(problem, start);
  EXPECT_EQ(refined.status, RefineStatus::not_solved) << refined.table();
  EXPECT_EQ(refined.meshes.size(), 2U);
  EXPECT_EQ(refined.meshes.back().status, nlp::Status::iteration_limit);
}

TEST(Refinement, CountsCostTermsThatAreNoPhases) {
  const auto record = [](bool beside) {
    PhasedProblem both("there and back");
    for (const double push : {1.0, -1.0}) {
      Problem p(push > 0 ? "there" : "back");
      const Expr v = p.state("v"), u = p.control("u", {push > 0 ? 0.1 : -1, push > 0 ? 1 : -0.1});
      p.dynamics(v, u - v * v * v);
      if (push > 0) p.initial_bounds(v, Bounds::equal(0));
      if (push < 0) p.final_bounds(v, Bounds::equal(-0.8));
      if (push < 0) p.initial_time({0, 10}, 1);
      p.final_time({0.1, 20}, push > 0 ? 1 : 2);
      if (push < 0 && !beside) p.mayer("arrival", 1e4 * p.final_time());
      both.add(p);
    }
    both.connect(0, 1);
    if (beside) both.mayer("arrival", 1e4 * both.phases()[1].final_time());
    const PhasedSettings start{.grids = {2, {Mesh::uniform(4), trapezoidal()}}};
    const PhasedRefined refined = refine(both, start, {.resolve_controls = false, .max_meshes = 1});
    EXPECT_EQ(refined.status, RefineStatus::mesh_limit);
    return refined.meshes.front();
  };
  const MeshRecord beside = record(true), inside = record(false);
  ASSERT_GT(inside.objective_error, 1e-6);
  EXPECT_NEAR(beside.objective_error / inside.objective_error, 1, 1e-3);
}

TEST(Refinement, RefusesSettingsThatCannotBe) {
  const auto form = regulator();
  RefineRules rules{.refinement = Refinement::hp};
  EXPECT_EQ(refusal([&] { (void)refine(form.problem, {}, rules); }),
            "linear regulator: refinement: hp: found the scheme hermite_simpson, expected lgr, "
            "lgr_differential, lgr_flipped or lgl, which have degrees");
  rules = {};
  rules.tolerance = std::nan("");
  EXPECT_EQ(refusal([&] { (void)refine(form.problem, {}, rules); }),
            "linear regulator: refinement: tolerance: found nan, expected a number > 0 and < 1");
  rules = {};
  rules.max_points = 2;
  EXPECT_EQ(refusal([&] { (void)refine(form.problem, {}, rules); }),
            "linear regulator: refinement: max_points: found 2, expected at least 3");
}

/// Least time from rest to rest with unlike forces: sqrt(2 way (1 / ahead + 1 / back)), the switch
/// where speed is `ahead` times its time.
Problem unlike_forces(double ahead, double back, double way) {
  Problem p("unlike forces");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u", {-back, ahead});
  p.dynamics(x, v);
  p.dynamics(v, u);
  fix(p, x, 0, way);
  fix(p, v, 0, 0);
  p.final_time({0.1, 100}, 5);
  p.mayer("duration", p.final_time());
  return p;
}

/// At a third of an interval of Hermite-Simpson, the parabola through a jump meets one neighbour
/// with equal value and slope.
TEST(Refinement, SeesAJumpAtAThirdOfAnInterval) {
  for (const auto& [ahead, back] : {std::pair{2.0, 1.0}, {1.0, 2.0}, {1.0, 5.0}, {1.9, 1.0}}) {
    const double right = std::sqrt(2 * 12 * (1 / ahead + 1 / back));
    for (const int intervals : {20, 40}) {
      const Refined refined =
          refine(unlike_forces(ahead, back, 12), {.mesh = Mesh::uniform(intervals)});
      SCOPED_TRACE(std::to_string(ahead) + "\n" + refined.table());
      ASSERT_EQ(refined.status, RefineStatus::converged);
      EXPECT_NEAR(refined.solution.tf() / right, 1, 5e-6);
    }
  }
}

/// The control of each phase is constant but for what the barrier keeps it off its bound.
TEST(Refinement, TakesNoBarrierForAJump) {
  PhasedProblem both("both");
  for (const bool stop : {false, true}) {
    Problem p(stop ? "stop" : "go");
    const Expr x = p.state("x"), v = p.state("v"), u = p.control("u", {-1, 1});
    p.dynamics(x, v);
    p.dynamics(v, u);
    for (const auto& [state, value] : {std::pair{x, stop ? 1.0 : 0.0}, {v, 0.0}})
      stop ? p.final_bounds(state, Bounds::equal(value))
           : p.initial_bounds(state, Bounds::equal(value));
    if (stop) p.initial_time({0, 10}, 1);
    p.final_time({0, 10}, stop ? 2 : 1);
    if (stop) p.mayer("duration", p.final_time());
    both.add(p);
  }
  both.connect(0, 1);
  PhasedSettings start;
  start.grids.assign(2, {Mesh::uniform(40), lgr(4)});
  const PhasedRefined refined = refine(both, start, {.refinement = Refinement::hp});
  SCOPED_TRACE(refined.table());
  EXPECT_EQ(refined.status, RefineStatus::converged);
  EXPECT_LE(refined.meshes.back().points, 1000U);
  EXPECT_NEAR(refined.solution.objective, 2, 2e-6);
}

/// States accurate to the tolerance may leave an objective that is not, where it is a small
/// difference of large terms. The estimate says how far it is off.
TEST(Refinement, LooksAtWhatErrorsMakeOfTheObjective) {
  Problem p("small difference");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, x + u);
  p.initial_bounds(x, Bounds::equal(1));
  p.lagrange("effort", 1e12 * square(u));
  p.mayer("end", 1e4 * (p.final(x) - std::exp(1.0)) + 1);
  const Refined refined = refine(p, {.mesh = Mesh::uniform(2)}, {.tolerance = 1e-4});
  SCOPED_TRACE(refined.table());
  ASSERT_EQ(refined.status, RefineStatus::converged);
  EXPECT_NEAR(refined.solution.objective, 1, 2e-3);
  EXPECT_GT(refined.meshes.size(), 1U);
  const Solution coarse = solve(p, {.mesh = Mesh::uniform(2)});
  const double off = 1 - coarse.objective;
  EXPECT_GT(std::fabs(off), 0.1) << "though its states are accurate to";
  EXPECT_LT(estimate_errors(p, coarse).largest, 1e-4);
  EXPECT_NEAR(estimate_errors(p, coarse).objective, off, 0.1 * std::fabs(off));
}

/// A drag that steps where no mesh has a node: x' = -x, from t = 0.37 on -3 x, with an effort.
Problem stepping(bool declared) {
  Problem p("stepping");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u - select(p.time() - 0.37, 3 * x, x));
  p.lagrange("cost", square(x - 1) + 0.1 * square(u));
  p.initial_bounds(x, Bounds::equal(1));
  if (declared) p.breakpoint(Moment::time(0.37));
  return p;
}

TEST(Refinement, RaisesNoDegreesAtAStepInVain) {
  const RefineRules rules{.tolerance = 1e-5, .refinement = Refinement::hp, .max_meshes = 30};
  const SolveSettings start{.mesh = Mesh::uniform(4), .scheme = lgr(3)};
  const Refined found = refine(stepping(false), start, rules);
  EXPECT_EQ(found.status, RefineStatus::converged) << found.table();
  EXPECT_LE(found.meshes.size(), 9u) << found.table();
  EXPECT_LE(found.meshes.back().points, 120u);
  // The node is seen by the interval before it alone, with the value from before the step.
  const SolveSettings flipped{.mesh = Mesh::uniform(4), .scheme = lgr_flipped(3)};
  const Refined declared = refine(stepping(true), flipped, rules);
  EXPECT_EQ(declared.status, RefineStatus::converged);
  EXPECT_LE(declared.meshes.size(), 2u) << declared.table();
  EXPECT_NEAR(found.solution.objective, declared.solution.objective, 1e-5);
}

}  // namespace
}  // namespace slalom::ocp
