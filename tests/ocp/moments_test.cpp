#include "slalom/ocp/moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "ocp/messages.hpp"
#include "ocp/pushed_mass.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/refine.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

/// x' = u from 1 over one second for the least integral of x^2 + u^2, with x(0.75) = 0.9.
Problem pinned() {
  Problem p("pinned");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u);
  p.lagrange("cost", square(x) + square(u));
  p.fix(x, 1, 0.75);
  p.path_at("pin", x, Moment::time(0.75), Bounds::equal(0.9));
  return p;
}

/// The least cost between two given values T apart (the Riccati solution of x' = u).
double between(double a, double b, double T) {
  return (a * a + b * b) / std::tanh(T) - 2 * a * b / std::sinh(T);
}

TEST(Moments, AValueGivenBetweenTheEndsIsKept) {
  const double best = between(1, 0.9, 0.75) + between(0.9, 0.75, 0.25);
  for (const std::string& backend : nlp::backends())
    for (const Scheme& scheme : {backward_euler(), trapezoidal(), hermite_simpson(),
                                 hermite_simpson_compressed(), lgr(4), lgr_flipped(3)}) {
      SCOPED_TRACE(scheme.name + " by " + backend);
      const Solution solution =
          solve(pinned(), {.mesh = Mesh::uniform(10), .scheme = scheme, .backend = backend});
      ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
      EXPECT_EQ(solution.mesh.intervals(), 11u);  // 0.75 lies within the eighth
      // The control jumps at the pin: schemes that collocate both ends run through the jump.
      const bool may_jump = !scheme.collocates(0) || !scheme.collocates(scheme.points.size() - 1);
      EXPECT_NEAR(solution.objective, best, may_jump && scheme.order > 2 ? 1e-6 : 0.05);
      double at = 0;
      for (std::size_t k = 0; k < solution.trajectory.tau.size(); ++k)
        if (std::fabs(solution.trajectory.time(k) - 0.75) < 1e-12)
          at = solution.trajectory.states[k][0];
      EXPECT_NEAR(at, 0.9, 1e-7);
    }
}

TEST(Moments, MultiplierIsTheCostsSlope) {
  const auto cost = [](double pin) { return between(1, pin, 0.75) + between(pin, 0.75, 0.25); };
  const Solution solution = solve(pinned(), {.mesh = Mesh::uniform(40), .scheme = lgr(4)});
  ASSERT_TRUE(solution.solved());
  const auto& multiplier = solution.multiplier("pin");
  ASSERT_EQ(multiplier.values.size(), 1u);
  EXPECT_NEAR(std::fabs(multiplier.values[0]), std::fabs(cost(0.901) - cost(0.899)) / 0.002, 1e-4);
}

/// A fit of x' = -k x to numbers near exp(-2 t), at times that no uniform mesh has.
Problem fit(const std::vector<double>& times) {
  Problem p("fit");
  const Expr x = p.state("x"), k = p.static_parameter("k", {0, 10}, 0.5);
  p.dynamics(x, -k * x);
  p.initial_bounds(x, Bounds::equal(1));
  p.final_time(Bounds::equal(2), 2);
  for (std::size_t i = 0; i < times.size(); ++i)
    p.cost_at("measured " + std::to_string(i), square(x - std::exp(-2 * times[i])),
              Moment::time(times[i]));
  return p;
}

TEST(Moments, CostsAtTimesFitAConstant) {
  const Solution solution = solve(fit({0.1, 1 / 3.0, 0.777, 1.9, 2}), {.mesh = Mesh::uniform(6)});
  ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
  EXPECT_NEAR(solution.static_parameter("k"), 2, 1e-3);
  EXPECT_LT(solution.objective, 1e-6);
  const Refined refined = refine(fit({0.1, 1 / 3.0, 0.777}), {.mesh = Mesh::uniform(2)});
  EXPECT_TRUE(refined.status == RefineStatus::converged);
  EXPECT_NEAR(refined.solution.static_parameter("k"), 2, 1e-5);
}

TEST(Moments, ASoftRowAtAMomentCostsItsExcessOnce) {
  Problem p = pinned();
  p.soften(p.constraint_named("pin"), {Norm::l2, 3});
  const Solution solution = solve(p, {.mesh = Mesh::uniform(20)});
  ASSERT_TRUE(solution.solved());
  const double excess = solution.excess("pin").values.at(0);
  EXPECT_GT(std::fabs(excess), 1e-3);
  EXPECT_NEAR(solution.cost_term("soft pin"), 3 * excess * excess, 1e-8);
}

TEST(Moments, SharesOfAHorizonWhoseEndIsFree) {
  PushedMass mass("half-way");  // least time, at most 0.2 fast when half of it is gone
  Problem& p = mass.problem;
  p.final_time({0.1, 20}, 4);
  p.mayer("time", p.final_time());
  p.path_at("slow", mass.v, Moment::share(0.5), Bounds::at_most(0.2));
  const Solution solution = solve(p, {.mesh = Mesh::uniform(21)});
  ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
  EXPECT_EQ(solution.mesh.intervals(), 22u);
  // Each half: up to w, and down to 0.2 at its end: (w^2 + (w^2 - 0.04)) / 2 = 1 / 2.
  const double w = std::sqrt(0.52);
  EXPECT_NEAR(solution.tf(), 2 * (w + w - 0.2), 2e-2);
}

TEST(Moments, BreakpointsAreNodesAndGridsKeepTheirSchemes) {
  Problem p = pinned();
  p.breakpoint(Moment::share(0.31));
  p.breakpoint(Moment::time(0.5));  // is one already
  const auto grid = with_moments(p, {Mesh::uniform(2), Schemes({hermite_simpson(), lgr(3)})});
  EXPECT_EQ(grid.mesh.breakpoints(), (std::vector{0.0, 0.31, 0.5, 0.75, 1.0}));
  EXPECT_EQ(grid.schemes.of(1).name, hermite_simpson().name);
  EXPECT_EQ(grid.schemes.of(2).points, lgr(3).points);
  const auto again = with_moments(p, grid);
  EXPECT_EQ(again.mesh.breakpoints(), grid.mesh.breakpoints());
  EXPECT_NE(refusal([&] {
              Transcription(p, Mesh::uniform(3), hermite_simpson());
            }).find("no node of the mesh"),
            std::string::npos);
}

TEST(Moments, OfPhasesAreTheirOwn) {
  PhasedProblem both("both");
  both.add(pinned());
  Problem after("after");
  const Expr x = after.state("x"), u = after.control("u");
  after.dynamics(x, u);
  after.lagrange("cost", square(x) + square(u));
  after.initial_time(Bounds::equal(1), 1);
  after.final_time(Bounds::equal(2), 2);
  after.path_at("pin", x, Moment::time(1.25), Bounds::equal(0.5));
  after.final_bounds(x, Bounds::equal(0));
  both.add(after);
  both.connect(0, 1);
  PhasedSettings settings;
  settings.grids.assign(2, {Mesh::uniform(10), lgr(3)});
  const PhasedSolution solution = solve(both, settings);
  ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
  EXPECT_NEAR(solution.phases[1].objective, between(0.75, 0.5, 0.25) + between(0.5, 0, 0.75), 1e-5);
}

TEST(Moments, WhatIsNoMomentIsRefused) {
  Problem p = pinned();
  p.cost_at("late", p.states()[0].symbol, Moment::time(1.5));
  EXPECT_EQ(refusal([&] { (void)solve(p); }),
            "pinned: late: found the time 1.5, expected one from t0 = 0 to tf = 1");
  p = pinned();
  p.final_time({0.5, 2}, 1);
  EXPECT_EQ(refusal([&] { (void)solve(p); }),
            "pinned: pin: found the time 0.75 where t0 or tf is free, expected a share of the "
            "horizon, or fixed ends");
  p = pinned();
  p.breakpoint(Moment::share(-0.1));
  EXPECT_EQ(refusal([&] { (void)solve(p); }),
            "pinned: breakpoint: found the share -0.1 of the horizon, expected one from 0 to 1");
}

}  // namespace
}  // namespace slalom::ocp
