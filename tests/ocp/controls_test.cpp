// Controls held or linear over their intervals, and the compressed Hermite-Simpson scheme.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ocp/closed_forms.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/errors.hpp"
#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

const Mesh kUneven({0, 0.15, 0.25, 0.5, 0.8, 1});

std::vector<Scheme> schemes() {
  return {trapezoidal(),
          hermite_simpson(),
          hermite_simpson_compressed(),
          lgr(1),
          lgr(3),
          lgr_differential(4),
          lgl(2),
          lgl(4),
          backward_euler()};
}

/// Least energy from rest to rest (closed_forms.hpp) with the control in a given form.
Problem least_energy(ControlForm form) {
  Problem p = ocp::least_energy().problem;
  p.control_form(p.controls()[0].symbol, form);
  return p;
}

TEST(HeldControls, AreTheQuadraticProgramsOptimum) {
  // x'' = u_k: sum h_k u_k = 0 and sum h_k u_k (1 - m_k) = 1 with m_k the middles make
  // u_k = c (a - m_k), a the mean of the middles weighted by h: exact for every scheme of order 2
  // at least, for x is a quadratic between the nodes.
  const auto& t = kUneven.breakpoints();
  double mean = 0, spread = 0;
  for (std::size_t k = 0; k + 1 < t.size(); ++k) mean += (t[k + 1] - t[k]) * (t[k] + t[k + 1]) / 2;
  for (std::size_t k = 0; k + 1 < t.size(); ++k)
    spread += (t[k + 1] - t[k]) * std::pow(mean - (t[k] + t[k + 1]) / 2, 2);
  const double c = 1 / spread, objective = c * c * spread / 2;
  for (const Scheme& scheme : schemes()) {
    if (scheme.order < 2) continue;
    SCOPED_TRACE(scheme.name);
    const Problem p = least_energy(ControlForm::constant);
    const Solution solution = solve(p, {.mesh = kUneven, .scheme = scheme});
    ASSERT_TRUE(solution.solved());
    EXPECT_NEAR(solution.objective, objective, 1e-6);
    EXPECT_LT(estimate_errors(p, solution).largest, 1e-8) << "what is between the nodes too";
    const Interpolant between(p, solution.trajectory, kUneven, scheme);
    for (std::size_t k = 0; k + 1 < t.size(); ++k)
      for (const double at : {0.0, 0.3, 1.0})
        EXPECT_NEAR(between.controls(k, at)[0], c * (mean - (t[k] + t[k + 1]) / 2), 1e-5) << k;
  }
}

TEST(HeldControls, OfOneKindLeaveTheOthersAsTheyAre) {
  // u1 is held and u2 not: u2 = 6 - 12 t whatever u1 does.
  Problem p("two");
  const Expr x = p.state("x"), v = p.state("v"), y = p.state("y"), w = p.state("w");
  const Expr a = p.control("a"), b = p.control("b");
  p.dynamics(x, v);
  p.dynamics(v, a);
  p.dynamics(y, w);
  p.dynamics(w, b);
  p.lagrange("effort", (square(a) + square(b)) / 2);
  p.control_form(a, ControlForm::constant);
  for (const auto& [position, speed] : {std::pair{x, v}, std::pair{y, w}}) {
    fix(p, position, 0, 1);
    fix(p, speed, 0, 0);
  }
  const Solution solution = solve(p, {.mesh = kUneven, .scheme = lgl(4)});
  ASSERT_TRUE(solution.solved());
  const auto u = solution.control("b"), t = solution.time();
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(u[k], 6 - 12 * t[k], 1e-5);
  const auto held = solution.control("a");
  for (std::size_t k = 0; k + 1 < t.size(); ++k)
    EXPECT_NEAR(held[k], held[k / 3 * 3], 1e-9) << "three points an interval";
}

TEST(LinearControls, AreLinesBetweenTheNodes) {
  for (const Scheme& scheme : schemes()) {
    if (scheme.order < 2 || scheme.points.size() < 3) continue;
    SCOPED_TRACE(scheme.name);
    const Problem p = least_energy(ControlForm::linear);
    const Solution solution = solve(p, {.mesh = kUneven, .scheme = scheme});
    ASSERT_TRUE(solution.solved());
    EXPECT_NEAR(solution.objective, 6, 1e-6) << "u = 6 - 12 t is linear";
    const auto u = solution.control("u"), t = solution.time();
    for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(u[k], 6 - 12 * t[k], 1e-5) << k;
  }
  // Where the optimum is no line, the interior points follow the ends.
  Problem p = bryson_denham(1.0 / 9).problem;
  p.control_form(p.controls()[0].symbol, ControlForm::linear);
  const Scheme scheme = lgr(4);
  const Solution solution = solve(p, {.mesh = Mesh::uniform(7), .scheme = scheme});
  ASSERT_TRUE(solution.solved());
  const auto u = solution.control("u");
  for (std::size_t k = 0; k < 7; ++k)
    for (std::size_t j = 1; j < 4; ++j)
      EXPECT_NEAR(u[4 * k + j], u[4 * k] + scheme.points[j] * (u[4 * k + 4] - u[4 * k]), 1e-7);
}

TEST(HeldControls, AreNotAskedToMeetEquationsToo) {
  // u + x = 0 makes x = exp(-t), and leaves no freedom at a point whose control is another's.
  for (const Scheme& scheme : schemes()) {
    if (scheme.order < 2) continue;
    SCOPED_TRACE(scheme.name);
    Problem p("equation");
    const Expr x = p.state("x"), u = p.control("u"), w = p.control("w");
    p.dynamics(x, u);
    p.path("law", u + x, Bounds::equal(0));
    p.path("circle", square(w), Bounds::equal(4));
    p.lagrange("cost", w);
    p.initial_bounds(x, Bounds::equal(1));
    Trajectory guess;
    guess.tau = {0, 1};
    guess.states = {{1}, {1}};
    guess.controls = {{0, -1}, {0, -1}};
    const Solution solution = solve(p, {.mesh = kUneven, .scheme = scheme, .guess = guess});
    ASSERT_TRUE(solution.solved()) << to_string(solution.status);
    EXPECT_NEAR(solution.state("x").back(), std::exp(-1), scheme.order > 2 ? 1e-4 : 1e-2);
    EXPECT_NEAR(solution.objective, -2, 1e-7);
  }
}

TEST(ControlForms, AreAskedForByTheControl) {
  Problem p("forms");
  const Expr x = p.state("x");
  EXPECT_THROW(p.control_form(x, ControlForm::linear), InvalidValue);
}

/// Costs that no quadrature treats the same at the midpoint and at the ends.
Problem pendulum(double most_power) {
  Problem p("pendulum");
  const Expr a = p.state("a", {-4, 4}), w = p.state("w"), u = p.control("u", {-3, 3});
  const Expr length = p.static_parameter("length", {0.5, 2}, 1);
  p.dynamics(a, w);
  p.dynamics(w, u - sin(a) / length - 0.1 * w * abs(w + 5) + 0.2 * sin(p.time()));
  p.lagrange("effort", square(u) + square(a) * length);
  p.path("power", u * w, Bounds::at_most(most_power));
  p.integral("travel", square(w), Bounds::at_most(6));
  fix(p, a, 0, 1);
  fix(p, w, 0, 0);
  p.final_time({1.5, 3}, 2);
  return p;
}

TEST(Compressed, IsTheSeparatedFormWithTheMidpointPutIn) {
  for (const auto form : {ControlForm::scheme, ControlForm::linear, ControlForm::constant}) {
    for (const double most_power : {0.4, 9.0}) {
      Problem p = pendulum(most_power);
      p.control_form(p.controls()[0].symbol, form);
      const Mesh mesh({0, 0.1, 0.3, 0.55, 0.7, 0.9, 1});
      SolveSettings settings{.mesh = mesh};
      settings.options.tol = 1e-10;
      const Solution separated = solve(p, settings);
      settings.scheme = hermite_simpson_compressed();
      const Solution compressed = solve(p, settings);
      ASSERT_TRUE(separated.solved());
      ASSERT_TRUE(compressed.solved());
      EXPECT_EQ(compressed.backend.find("generic"), std::string::npos) << compressed.backend;
      EXPECT_NEAR(compressed.objective, separated.objective, 1e-8);
      EXPECT_LT(compressed.point.x.size(), separated.point.x.size());
      for (std::size_t k = 0; k < separated.trajectory.tau.size(); ++k)
        for (std::size_t i = 0; i < 2; ++i)
          EXPECT_NEAR(compressed.trajectory.states[k][i], separated.trajectory.states[k][i], 1e-6);
      for (std::size_t k = 0; k <= mesh.intervals() && most_power > 1; ++k)
        for (std::size_t i = 0; i < 2; ++i)
          EXPECT_NEAR(compressed.costates[k][i], separated.costates[k][i], 1e-5) << k << " " << i;
      const auto power = separated.multiplier("power").values;
      EXPECT_EQ(*std::max_element(power.begin(), power.end()) > 0.01, most_power < 1);
      for (std::size_t k = 0; k < power.size(); ++k)
        EXPECT_NEAR(compressed.multiplier("power").values[k], power[k], 1e-5);
    }
  }
}

}  // namespace
}  // namespace slalom::ocp
