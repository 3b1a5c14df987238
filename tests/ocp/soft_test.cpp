// Soft constraints, and the multipliers of all constraints by name.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

double largest(const std::vector<double>& list) {
  return *std::max_element(list.begin(), list.end());
}

/// Bryson-Denham with its bound as a path row, so that it can be softened.
struct Wall {
  Problem problem{"wall"};
  Expr x = problem.state("x"), v = problem.state("v"), u = problem.control("u");
  ConstraintId wall = problem.path("wall", x, Bounds::at_most(1.0 / 9));

  Wall() {
    problem.dynamics(x, v);
    problem.dynamics(v, u);
    problem.lagrange("effort", square(u) / 2);
    fix(problem, x, 0, 0);
    fix(problem, v, 1, -1);
  }
};

TEST(Soft, ExactPenaltyAboveTheMultiplierIsTheHardConstraint) {
  for (const Scheme& scheme :
       {trapezoidal(), hermite_simpson(), hermite_simpson_compressed(), lgr(4), lgl(4)}) {
    SCOPED_TRACE(scheme.name);
    Wall wall;
    const SolveSettings settings{.mesh = Mesh::uniform(12), .scheme = scheme};
    const Solution hard = solve(wall.problem, settings);
    wall.problem.soften(wall.wall, {Norm::l1, 1e4, 0});
    const Solution soft = solve(wall.problem, settings);
    wall.problem.soften(wall.wall, {Norm::l1, 1, 0});
    const Solution cheap = solve(wall.problem, settings);
    wall.problem.harden(wall.wall);
    const Solution again = solve(wall.problem, settings);
    ASSERT_TRUE(hard.solved() && soft.solved() && cheap.solved() && again.solved());
    EXPECT_NEAR(soft.objective, hard.objective, 1e-5);
    EXPECT_NEAR(soft.cost_term("soft wall"), 0, 1e-5);
    EXPECT_LT(largest(soft.excess("wall").values), 1e-6);
    EXPECT_LT(cheap.objective, hard.objective - 0.1);
    EXPECT_GT(largest(cheap.excess("wall").values), 0.01);
    for (std::size_t k = 0; k < cheap.trajectory.tau.size(); ++k)
      EXPECT_NEAR(cheap.excess("wall").values[k],
                  std::max(cheap.trajectory.states[k][0] - 1.0 / 9, 0.0), 1e-5);
    EXPECT_NEAR(again.objective, hard.objective, 1e-9);
    EXPECT_TRUE(hard.excesses.empty());
  }
}

TEST(Soft, ToleranceIsFree) {
  Wall wall, wider;
  wall.problem.soften(wall.wall, {Norm::l1, 1e4, 0.02});
  wider.problem.path("other", wider.x, Bounds::at_most(1.0 / 9 + 0.02));
  wider.problem.enable(wider.wall, false);
  const SolveSettings settings{.mesh = Mesh::uniform(12)};
  const Solution soft = solve(wall.problem, settings), hard = solve(wider.problem, settings);
  ASSERT_TRUE(soft.solved() && hard.solved());
  EXPECT_NEAR(soft.objective, hard.objective, 1e-5);
}

/// From rest at 0, least half of the integral of u^2, v(1) = 1 at the cost w e^2 or w |e|: u = c
/// constant, cost c^2/2 + w (c - 1)^2 or + w (1 - c).
Solution push(Soft soft, Bounds bounds = Bounds::equal(1)) {
  Problem p("push");
  const Expr v = p.state("v"), u = p.control("u");
  p.dynamics(v, u);
  p.lagrange("effort", square(u) / 2);
  p.initial_bounds(v, Bounds::equal(0));
  p.soften(p.boundary("goal", p.final(v), bounds), soft);
  return solve(p, {.mesh = Mesh::uniform(5)});
}

TEST(Soft, BoundaryRowsOfBothNorms) {
  for (const double w : {0.3, 1.0, 10.0}) {
    const Solution square = push({Norm::l2, w, 0});
    ASSERT_TRUE(square.solved());
    EXPECT_NEAR(square.state("v").back(), 2 * w / (1 + 2 * w), 1e-6);
    EXPECT_NEAR(square.excess("goal").values[0], -1 / (1 + 2 * w), 1e-6);
    EXPECT_NEAR(square.cost_term("soft goal"), w / std::pow(1 + 2 * w, 2), 1e-6);
    const Solution absolute = push({Norm::l1, w, 0}, Bounds::at_least(1));
    ASSERT_TRUE(absolute.solved());
    EXPECT_NEAR(absolute.state("v").back(), std::min(w, 1.0), 1e-4) << w;
    const Solution equal = push({Norm::l1, w, 0.1});
    EXPECT_NEAR(equal.state("v").back(), std::min(w, 0.9), 1e-4) << w;
  }
}

TEST(Soft, CostIsTheIntegralOfTheExcessOnAnyMesh) {
  // x = t whatever the control: x <= 1/2 is exceeded by t - 1/2: integral 1/8, of squares 1/24.
  for (const Scheme& scheme : {trapezoidal(), hermite_simpson(), lgr(3)})
    for (const Norm norm : {Norm::l1, Norm::l2}) {
      Problem p("clock");
      const Expr x = p.state("x"), y = p.state("y"), u = p.control("u");
      p.dynamics(x, 0.5);  // over 2 seconds
      p.dynamics(y, u);
      p.lagrange("effort", square(u));
      p.initial_bounds(x, Bounds::equal(0));
      p.initial_bounds(y, Bounds::equal(0));
      p.final_time(Bounds::equal(2), 2);
      p.soften(p.path("half", x, Bounds::at_most(0.5)), {norm, 3, 0});
      const Solution solution = solve(p, {.mesh = Mesh::uniform(50), .scheme = scheme});
      ASSERT_TRUE(solution.solved());
      EXPECT_NEAR(solution.cost_term("soft half"), 3 * 2 * (norm == Norm::l1 ? 1.0 / 8 : 1.0 / 24),
                  2e-3);
    }
}

TEST(Soft, FamiliesAreSoftMemberByMember) {
  Problem p("gates");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u"), limit = Expr::symbol("limit");
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.lagrange("effort", square(u) / 2);
  fix(p, x, 0, 0);
  fix(p, v, 1, -1);
  const auto gates = p.path_family("gate", {limit}, x - limit, Bounds::at_most(0));
  p.set_members(gates, {"low", "high"}, {{0.11}, {0.2}});
  p.soften(gates, {Norm::l1, 2, 0});
  const Solution solution = solve(p, {.mesh = Mesh::uniform(20)});
  ASSERT_TRUE(solution.solved());
  const auto& excess = solution.excess("gate");
  ASSERT_EQ(excess.values.size(), 2 * solution.trajectory.tau.size());
  for (std::size_t k = 0; k < excess.values.size(); ++k) {
    const double x_k = solution.trajectory.states[excess.points[k]][0];
    const double low = std::max(x_k - 0.11, 0.0), high = std::max(x_k - 0.2, 0.0);
    EXPECT_LT(std::min(std::fabs(excess.values[k] - low), std::fabs(excess.values[k] - high)),
              1e-5);
  }
}

TEST(Soft, WeightsChangeBetweenSolvesOfOneTranscription) {
  Wall wall;
  wall.problem.soften(wall.wall, {Norm::l1, 1, 0});
  Transcription transcription(wall.problem, Mesh::uniform(6), hermite_simpson());
  const std::vector<double> x(transcription.structure().variables, 0.3);
  wall.problem.soften(wall.wall, {Norm::l1, 5, 0});
  transcription.update(wall.problem);
  Transcription fresh(wall.problem, Mesh::uniform(6), hermite_simpson());
  nlp::Evaluation a, b;
  transcription.evaluate(x, 1, {}, {.values = true, .derivatives = true}, a);
  fresh.evaluate(x, 1, {}, {.values = true, .derivatives = true}, b);
  EXPECT_EQ(a.objective, b.objective);
  EXPECT_EQ(a.gradient, b.gradient);
  wall.problem.soften(wall.wall, {Norm::l2, 5, 0});
  EXPECT_THROW(transcription.update(wall.problem), InvalidValue);
  wall.problem.harden(wall.wall);
  EXPECT_THROW(transcription.update(wall.problem), InvalidValue);
}

TEST(Soft, ErrorsSayWhatAndTheRule) {
  Wall wall;
  EXPECT_EQ(refusal([&] {
              wall.problem.soften(wall.wall, {Norm::l1, -1, 0});
            }),
            "wall: wall: weight: found -1, expected a finite number > 0");
  EXPECT_EQ(refusal([&] {
              wall.problem.soften(wall.wall, {Norm::l2, 1, std::nan("")});
            }),
            "wall: wall: tolerance: found nan, expected a finite number >= 0");
  EXPECT_EQ(refusal([&] { (void)wall.problem.constraint_named("wal"); }),
            "wall: found no constraint 'wal', expected perhaps 'wall'");
  EXPECT_EQ(wall.problem.constraint_named("wall").index, wall.wall.index);
}

TEST(Multipliers, SayWhatABoundCosts) {
  // The objective's change when a bound is moved at all points is the sum of its multipliers.
  for (const Scheme& scheme : {trapezoidal(), hermite_simpson(), lgr(4)}) {
    SCOPED_TRACE(scheme.name);
    const auto at = [&](double bound, double goal, double most) {
      Problem p("bounds");
      const Expr x = p.state("x", Bounds::at_most(bound), 0.3), v = p.state("v", {}, 2);
      const Expr u = p.control("u", {-most, most}, 4);
      p.dynamics(x, v);
      p.dynamics(v, u);
      p.lagrange("effort", square(u) / 2);
      fix(p, x, 0, 0);
      p.initial_bounds(v, Bounds::equal(1));
      p.boundary("goal", 2 * p.final(v), {goal, 5});
      SolveSettings settings{.mesh = Mesh::uniform(10), .scheme = scheme};
      settings.options.tol = 1e-11;
      return solve(p, settings);
    };
    const auto sum = [](const std::vector<double>& list, double sign) {
      double total = 0;
      for (const double value : list)
        if (value * sign > 0) total += value;
      return total;
    };
    const Solution solution = at(0.12, -1, 6.5);
    ASSERT_TRUE(solution.solved());
    const double h = 1e-5;
    const auto& x = solution.multiplier("x").values;  // at the ends, of what fixes x there
    const std::vector<double> inner(x.begin() + 1, x.end() - 1);
    const auto slope = [&](const Solution& up, const Solution& down) {
      return -(up.objective - down.objective) / (2 * h);
    };
    EXPECT_NEAR(slope(at(0.12 + h, -1, 6.5), at(0.12 - h, -1, 6.5)), sum(inner, 1), 1e-3);
    EXPECT_NEAR(slope(at(0.12, -1 + h, 6.5), at(0.12, -1 - h, 6.5)),
                solution.multiplier("goal").values[0], 1e-4);
    const auto& u = solution.multiplier("u").values;
    EXPECT_NEAR(slope(at(0.12, -1, 6.5 + h), at(0.12, -1, 6.5 - h)), sum(u, 1) - sum(u, -1), 1e-3);
  }
}

}  // namespace
}  // namespace slalom::ocp
