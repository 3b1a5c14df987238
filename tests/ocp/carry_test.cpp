// Trajectory and multipliers carried from one mesh and scheme to another.

#include <gtest/gtest.h>

#include <cmath>

#include "ocp/closed_forms.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/refine.hpp"
#include "slalom/ocp/scaling.hpp"
#include "slalom/ocp/transcription.hpp"
#include "support/sanitized.hpp"

namespace slalom::ocp {
namespace {

/// Everything that has a multiplier: path rows, a family, bounds, an integral, end values used
/// elsewhere, a soft row, a free end.
Problem everything() {
  Problem p("everything");
  const Expr x = p.state("x", Bounds::at_most(1.15)), v = p.state("v"), u = p.control("u", {-4, 4});
  const Expr q = p.integral("q", square(v), Bounds::at_most(2.2));
  const Expr member = Expr::symbol("member");
  p.dynamics(x, v);
  p.dynamics(v, u - 0.2 * v - 0.1 * p.final(x) * x);
  p.lagrange("effort", square(u) / 2 + 0.1 * p.initial(v));
  p.mayer("duration", 2 * p.final_time() + 0.1 * q);
  p.path("fast", v + 0.1 * x, Bounds::at_most(1.1));
  const auto family = p.path_family("brake", {member}, u + member * v, Bounds::at_least(-2.4));
  p.set_members(family, {"one", "two"}, {{0.1}, {0.5}});
  p.soften(p.path("soft", u, Bounds::at_most(1.5)), {Norm::l1, 0.4, 0});
  p.final_time({0.5, 5}, 1.5);
  fix(p, x, 0, 1.1);
  fix(p, v, 0.2, 0);
  return p;
}

TEST(Carry, ToTheSameMeshGivesTheSameMultipliers) {
  const Problem p = everything();
  for (const Scheme& scheme : {trapezoidal(), hermite_simpson(), hermite_simpson_compressed(),
                               backward_euler(), lgr(3), lgr_differential(4), lgl(4)}) {
    SCOPED_TRACE(scheme.name);
    SolveSettings settings{.mesh = Mesh({0, 0.1, 0.2, 0.35, 0.5, 0.6, 0.8, 1}), .scheme = scheme};
    settings.options.tol = 1e-10;
    const Solution solution = solve(p, settings);
    ASSERT_TRUE(solution.solved());
    Transcription transcription(p, settings.mesh, scheme);
    const nlp::Start start = transcription.carried(
        solution.trajectory,
        {solution.trajectory.tau, solution.collocated_costates, solution.multipliers});
    const auto same = [&](const std::vector<double>& carried, const std::vector<double>& known,
                          double tolerance, auto name) {
      ASSERT_EQ(carried.size(), known.size());
      for (std::size_t i = 0; i < known.size(); ++i)
        EXPECT_NEAR(carried[i], known[i], tolerance * (1 + std::fabs(known[i]))) << name(i);
    };
    const auto variable = [&](std::size_t i) { return transcription.variable_name(i); };
    same(start.x, solution.point.x, 1e-6, variable);
    same(start.zl, solution.point.zl, 2e-2, variable);
    same(start.zu, solution.point.zu, 1e-6, variable);
    // Where the scheme has fewer defects than rates there, rows share what least squares leave.
    for (std::size_t r = 0; r < start.y.size(); ++r)
      if (const auto name = transcription.row_name(r); name.find("held") == std::string::npos)
        EXPECT_NEAR(start.y[r], solution.point.y[r], 2e-2 * (1 + std::fabs(solution.point.y[r])))
            << name;
    settings.previous = &solution;
    const Solution again = solve(p, settings);
    ASSERT_TRUE(again.solved());
    EXPECT_LE(again.iterations, 5);
    EXPECT_LT(again.iterations, solution.iterations / 2);
  }
}

TEST(Carry, ToAnotherMeshAndSchemeIsAWarmStart) {
  const Problem p = everything();
  SolveSettings settings{.mesh = Mesh::uniform(12), .scheme = trapezoidal()};
  const Solution coarse = solve(p, settings);
  ASSERT_TRUE(coarse.solved());
  int warm = 0, cold = 0;
  for (const Scheme& scheme : {hermite_simpson(), lgr(3), lgl(4), trapezoidal()}) {
    SolveSettings fine{.mesh = Mesh::uniform(20), .scheme = scheme};
    const Solution from_nothing = solve(p, fine);
    fine.previous = &coarse;
    const Solution carried = solve(p, fine);
    ASSERT_TRUE(from_nothing.solved() && carried.solved()) << scheme.name;
    EXPECT_NEAR(carried.objective, from_nothing.objective, 1e-6);
    warm += carried.iterations;
    cold += from_nothing.iterations;
  }
  EXPECT_LT(warm, 0.7 * cold);
}

/// A start, a coast and a stop, of one problem.
PhasedProblem three_phases() {
  PhasedProblem all("trip");
  std::vector<Bounds> push = {{0, 2}, Bounds::equal(0), {-1, 0}};
  for (std::size_t k = 0; k < 3; ++k) {
    Problem p("leg " + std::to_string(k));
    const Expr x = p.state("x"), v = p.state("v", {0, 1}), u = p.control("u", push[k]);
    p.dynamics(x, v);
    p.dynamics(v, u - 0.1 * v * v);
    p.lagrange("effort", 0.05 * square(u));
    if (k == 0) {
      p.initial_bounds(x, Bounds::equal(0));
      p.initial_bounds(v, Bounds::equal(0));
    } else {
      p.initial_time({0, 10}, static_cast<double>(k));
    }
    p.final_time({0.01, 10}, static_cast<double>(k) + 1);
    if (k == 2) {
      p.final_bounds(x, Bounds::equal(3));
      p.final_bounds(v, Bounds::equal(0));
      p.mayer("arrival", p.final_time());
    }
    all.add(p);
    if (k > 0) all.connect(k - 1, k);
  }
  return all;
}

TEST(Carry, PhasesRefineEachByItsOwnErrors) {
  const PhasedProblem problem = three_phases();
  PhasedSettings start;
  start.grids = {
      {Mesh::uniform(2), lgr(3)}, {Mesh::uniform(1), lgr(2)}, {Mesh::uniform(3), lgl(3)}};
  for (const Refinement refinement : {Refinement::h, Refinement::hp}) {
    const PhasedRefined refined = refine(problem, start, {.refinement = refinement});
    SCOPED_TRACE(refined.table());
    ASSERT_EQ(refined.status, RefineStatus::converged);
    ASSERT_EQ(refined.errors.size(), 3U);
    for (std::size_t p = 0; p < 3; ++p)
      EXPECT_LE(estimate_errors(problem.phases()[p], refined.solution.phases[p]).largest, 1e-6);
    EXPECT_GT(refined.meshes.size(), 1U);
    EXPECT_NE(refined.table().find(" of leg "), std::string::npos);
    PhasedSettings again;
    for (const auto& phase : refined.solution.phases)
      again.grids.push_back({phase.mesh, phase.scheme});
    const PhasedSolution cold = solve(problem, again);
    ASSERT_TRUE(cold.solved());
    EXPECT_NEAR(cold.objective, refined.solution.objective, 1e-6);
    EXPECT_NEAR(cold.objective, 3.89192, 1e-5) << "as by a mesh of 800 intervals";
    EXPECT_LE(refined.meshes.back().iterations, cold.iterations);
  }
  start.previous = nullptr;
  PhasedSolution one;
  one.phases.resize(1);
  start.previous = &one;
  EXPECT_THROW((void)solve(problem, start), InvalidValue);
}

TEST(Carry, OfALinkThatTheAnswerHasNotIsZero) {
  PhasedProblem problem = three_phases();
  const PhasedSolution before = solve(problem);
  ASSERT_TRUE(before.solved());
  const auto& phases = problem.phases();
  problem.link("slow enough", phases[2].final_time() - phases[0].final_time(), Bounds::at_most(50));
  PhasedSettings start;
  start.previous = &before;
  const PhasedSolution after = solve(problem, start);
  ASSERT_TRUE(after.solved());
  EXPECT_NEAR(after.objective, before.objective, 1e-6);
  EXPECT_LT(after.iterations, before.iterations);
}

TEST(Carry, TakesAPointThatFitsBeforeAnAnswer) {
  Problem p = bryson_denham(1.0 / 9).problem;
  const auto wall = p.path("wall", p.states()[1].symbol, Bounds::at_least(-0.9));
  const Solution rough = solve(p, {.mesh = Mesh::uniform(5)});
  SolveSettings settings{.mesh = Mesh::uniform(40)};
  settings.warm_start = solve(p, settings).point;
  const int by_point = solve(p, settings).iterations;
  settings.previous = &rough;
  EXPECT_LE(solve(p, settings).iterations, by_point + 1);
  p.enable(wall, false);
  EXPECT_TRUE(solve(p, settings).solved()) << "the point has a row too many";
}

/// An answer to many points is carried in a time that grows as they do.
TEST(Carry, TakesNoLongerThanItHasPoints) {
  constexpr int kIntervals = kSanitized ? 15000 : 60000;
  Problem p("long");
  const Expr x = p.state("x", {-1, 1}), u = p.control("u", {-1, 1});
  p.dynamics(x, u);
  p.path("sum", x + u, {-1, 1});
  p.lagrange("effort", square(u));
  const Mesh mesh = Mesh::uniform(kIntervals);
  Transcription transcription(p, mesh, trapezoidal());
  Trajectory guess;
  Duals duals;
  for (const double tau : mesh.breakpoints()) {
    guess.tau.push_back(tau);
    guess.states.push_back({0.5 * tau});
    guess.controls.push_back({0.5});
    duals.tau.push_back(tau);
    duals.costates.tau.push_back(tau);
    duals.costates.values.push_back({1});
  }
  guess.tf = 1;
  for (const char* name : {"x", "u", "sum"}) {
    Multipliers& each = duals.multipliers.emplace_back();
    each.name = name;
    for (std::size_t point = 0; point < guess.tau.size(); ++point) {
      each.points.push_back(point);
      each.values.push_back(1e-3);
    }
  }
  const Timer timer;
  const nlp::Start start = transcription.carried(guess, duals);
  EXPECT_LT(timer.cpu(), 3);
  EXPECT_EQ(start.y.size(), transcription.structure().rows);
}

}  // namespace
}  // namespace slalom::ocp
