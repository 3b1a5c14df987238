// Solutions judged between their points: interpolation, re-integration, violations, Hamiltonian.

#include "slalom/ocp/errors.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"
#include "ocp/orders.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

std::vector<Scheme> all_schemes() {
  return {backward_euler(), trapezoidal(), hermite_simpson(), lgr(1), lgr(5), lgr_differential(3),
          lgl(4),           lgl(9)};
}

/// The regulator, whose states and controls between the points are known.
TEST(Interpolants, FollowTheSolutionBetweenThePoints) {
  const auto form = regulator();
  for (const auto& scheme : all_schemes()) {
    SCOPED_TRACE(scheme.name + fmt::format(" {}", scheme.points.size()));
    const Mesh mesh = graded(24);
    const Solution solution = solve(form.problem, {.mesh = mesh, .scheme = scheme});
    ASSERT_TRUE(solution.solved());
    const Interpolant between(form.problem, solution.trajectory, mesh, scheme);
    // A line through the nodes would be off by 1e-4. Only with Gauss's points has the control the
    // states' order; the trapezoidal rule's last one has order 1, Hermite-Simpson's 2.
    const double tolerance = scheme.order == 1 ? 0.03 : scheme.order == 2 ? 1e-3 : 1e-6;
    const double of_control = scheme.order <= 2 ? 0.06 : scheme.order == 4 ? 1e-3 : 1e-4;
    for (const double t : {0.0, 0.07, 0.15, 0.2, 0.444, 0.5, 0.77, 0.99, 1.0}) {
      EXPECT_NEAR(between.states(t)[0], form.states(t)[0], tolerance) << t;
      EXPECT_NEAR(between.controls(t)[0], -std::sinh(1 - t) / std::cosh(1), of_control) << t;
    }
    EXPECT_EQ(between.states(-1.0), between.states(0.0));
    EXPECT_EQ(between.states(2.0), between.states(1.0));
  }
}

TEST(Interpolants, PassThroughTheNodesOnSchemesThatDifferByInterval) {
  const auto form = brachistochrone();
  const Mesh mesh({0, 0.2, 0.6, 1});
  const Schemes schemes({lgr(3), lgr(6), lgr(4)});
  const Solution solution =
      solve(form.problem, {.mesh = mesh, .scheme = schemes, .guess = form.guess});
  ASSERT_TRUE(solution.solved());
  const Interpolant between(form.problem, solution.trajectory, mesh, schemes);
  for (std::size_t k = 0, point = 0; k < 3; ++k) {
    point += schemes.of(k).points.size() - 1;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(between.states(k, 1)[i], solution.trajectory.states[point][i], 1e-7);
      if (k < 2) EXPECT_EQ(between.states(k + 1, 0)[i], solution.trajectory.states[point][i]);
    }
  }
  const Trajectory again = between.resampled(mesh, schemes);
  for (std::size_t point = 0; point < again.tau.size(); ++point)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(again.states[point][i], solution.trajectory.states[point][i], 1e-7);
  EXPECT_EQ(refusal([&] {
              return Interpolant(form.problem, solution.trajectory, Mesh::uniform(4),
                                 schemes.of(0));
            }),
            "brachistochrone: interpolation: found 14 points, expected 13, those of the mesh");
}

TEST(Errors, OfAnExactSolutionAreTheIntegratorsAndShrinkByTheSchemesOrder) {
  EXPECT_LT(estimate_errors(least_energy().problem, solve(least_energy().problem)).largest, 1e-9);
  const auto form = brachistochrone();
  for (const auto& scheme : {trapezoidal(), hermite_simpson(), lgr(2)}) {
    SCOPED_TRACE(scheme.name);
    const auto error = [&](int n) {
      SolveSettings settings{.mesh = Mesh::uniform(n), .scheme = scheme, .guess = form.guess};
      settings.options.tol = 1e-11;
      return estimate_errors(form.problem, solve(form.problem, settings)).largest;
    };
    // An interval's own error has one order more than the solution.
    EXPECT_NEAR(std::log2(error(8) / error(16)), scheme.order + 1, 0.6);
  }
}

TEST(Errors, AreThoseOfAnIndependentIntegration) {
  // No control by backward Euler on x' = -x + u, so that an interval's end is known.
  Problem p("decay");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u - x);
  p.lagrange("effort", square(u));
  p.initial_bounds(x, Bounds::equal(1));
  const Solution solution = solve(p, {.mesh = Mesh::uniform(2), .scheme = backward_euler()});
  const ErrorEstimate estimate = estimate_errors(p, solution);
  const double first = 1 / 1.5, end = first / 1.5, decay = std::exp(-0.5);
  EXPECT_NEAR(estimate.interval[0], (first - decay) / 2, 1e-7);
  EXPECT_NEAR(estimate.interval[1], first * (1 / 1.5 - decay) / 2, 1e-7);
  EXPECT_NEAR(estimate.horizon, (end - decay * decay) / 2, 1e-7);
  EXPECT_EQ(estimate.worst, 0U);
  EXPECT_EQ(estimate.state[0], "x");
  EXPECT_LT(estimate.amplification, 1);
}

TEST(Errors, CountTheQuadratureOfTheCostAndOfIntegrals) {
  // States at rest are exact; the trapezoidal rule for the integral of sin^2(3 t) is not.
  Problem p("clock");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u);
  p.lagrange("cost", square(u) + square(sin(3 * p.time())));
  p.integral("area", 5 * square(sin(3 * p.time())) - 1);
  p.initial_bounds(x, Bounds::equal(0));
  const Solution solution = solve(p, {.mesh = Mesh({0, 0.4, 1}), .scheme = trapezoidal()});
  ASSERT_TRUE(solution.solved());
  const auto f = [](double t) { return std::pow(std::sin(3 * t), 2); };
  const auto exact = [](double t) { return t / 2 - std::sin(6 * t) / 12; };
  const double first = 0.2 * (f(0) + f(0.4)), second = 0.3 * (f(0.4) + f(1));
  const auto estimate = estimate_errors(p, solution);
  // The cost is relative to twice its size, the objective being that integral alone.
  const double error = std::fabs(first - exact(0.4)) / (2 * (first + second));
  EXPECT_GT(estimate.interval[0], error - 1e-9);
  EXPECT_EQ(estimate.state[1], "area");
  const double size = 0.2 * (1 + std::fabs(5 * f(0.4) - 1)) +
                      0.3 * (std::fabs(5 * f(0.4) - 1) + std::fabs(5 * f(1) - 1));
  EXPECT_NEAR(estimate.interval[1], 5 * std::fabs(second - exact(1) + exact(0.4)) / size, 1e-7);
  EXPECT_LT(estimate.horizon, 1e-9) << "of the states alone";
}

TEST(UnresolvedControls, AreWhereAControlJumpsOrBendsWithinAnInterval) {
  const auto form = moon_lander();  // one switch, of thrust 0 to 3
  for (const Scheme& scheme : {trapezoidal(), hermite_simpson(), lgr(4), lgl(4)}) {
    SCOPED_TRACE(scheme.name);
    const Solution solution = solve(form.problem, {.mesh = Mesh::uniform(20), .scheme = scheme});
    ASSERT_TRUE(solution.solved());
    const auto unresolved = unresolved_controls(form.problem, solution);
    double when = 0;  // thrust begins when x has fallen far enough
    const auto u = solution.control("u"), t = solution.time();
    for (std::size_t k = 0; k < u.size(); ++k)
      if (u[k] < 1.5) when = t[k] / t.back();
    const auto worst = static_cast<std::size_t>(
        std::max_element(unresolved.begin(), unresolved.end()) - unresolved.begin());
    EXPECT_NEAR((static_cast<double>(worst) + 0.5) / 20, when, 0.08);
    EXPECT_GT(unresolved[worst], 1e-4);
    for (std::size_t k = 0; k < 20; ++k)
      if (std::fabs(static_cast<double>(k) - static_cast<double>(worst)) > 2)
        EXPECT_LT(unresolved[k], 1e-6) << k;
  }
  // A smooth control is resolved.
  const auto smooth = regulator();
  const auto all = unresolved_controls(
      smooth.problem, solve(smooth.problem, {.mesh = Mesh::uniform(10), .scheme = lgr(5)}));
  EXPECT_LT(*std::max_element(all.begin(), all.end()), 1e-7);
}

TEST(Errors, SayWhereDynamicsBlowUpAndWhereTheyAmplify) {
  const auto unstable = [](double rate) {
    Problem p("unstable");
    const Expr x = p.state("x"), u = p.control("u");
    p.dynamics(x, rate * x + u);
    p.lagrange("cost", square(x) + square(u));
    p.initial_bounds(x, Bounds::equal(1));
    return estimate_errors(p, solve(p, {.mesh = Mesh::uniform(20), .scheme = lgr(3)}));
  };
  EXPECT_GT(unstable(12).amplification, 1e2);
  EXPECT_LT(unstable(-1).amplification, 2);

  Problem p("blow-up");
  const Expr x = p.state("x");
  p.dynamics(x, square(x));
  p.initial_bounds(x, Bounds::equal(1));
  p.final_time(Bounds::equal(3), 3);
  Solution solution;  // never solved: it claims a straight line past the pole at t = 1
  solution.trajectory = {0, 3, {0, 1}, {{1}, {2}}, {{}, {}}, {}, {}};
  EXPECT_EQ(estimate_errors(p, solution).largest, kInfinity);
  EXPECT_EQ(refusal([&] { return estimate_errors(p, solution, 0); }),
            "blow-up: integrator's tolerance: found 0, expected a number > 0 and < 1");
}

TEST(Violations, AreFoundBetweenTheNodesAndNamed) {
  const auto form = bryson_denham(1.0 / 5);
  const Solution coarse =
      solve(form.problem, {.mesh = Mesh({0, 0.3, 0.7, 1}), .scheme = trapezoidal()});
  ASSERT_TRUE(coarse.solved());
  const Violation found = largest_violation(form.problem, coarse);
  EXPECT_EQ(found.constraint, "x");
  EXPECT_GT(found.value, 1e-3);
  const Interpolant between(form.problem, coarse.trajectory, coarse.mesh, coarse.scheme);
  EXPECT_NEAR(between.states(found.time)[0] - 0.2, found.value, 1e-12);
  const Solution fine = solve(form.problem, {.mesh = Mesh::uniform(40)});
  EXPECT_LT(largest_violation(form.problem, fine).value, 1e-5);
}

TEST(Hamiltonians, AreConstantWhereNothingDependsOnTime) {
  const auto form = regulator();  // H = (x^2 - u^2) / 2 = 1 / (2 cosh(1)^2)
  for (const auto& scheme : {trapezoidal(), hermite_simpson(), lgr(3), lgl(4)}) {
    const Solution solution = solve(form.problem, {.mesh = Mesh::uniform(40), .scheme = scheme});
    for (const double h : hamiltonian(form.problem, solution))
      EXPECT_NEAR(h, 0.5 / (std::cosh(1) * std::cosh(1)), scheme.order == 2 ? 2e-3 : 1e-4)
          << scheme.name;
  }
  const auto fall = brachistochrone();  // of least time, from the end's cost 1: H = -1
  const Solution solution = solve(fall.problem, {.scheme = lgr(3), .guess = fall.guess});
  for (const double h : hamiltonian(fall.problem, solution)) EXPECT_NEAR(h, -1, 1e-3);
}

}  // namespace
}  // namespace slalom::ocp
