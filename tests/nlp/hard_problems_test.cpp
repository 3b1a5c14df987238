// Problems that have a solution and make it hard to reach: each must end there.

#include <numbers>

#include "nlp/hard_problems.hpp"

namespace slalom::nlp {
namespace {

class SolvableProblem : public HardProblem {};
INSTANTIATE_TEST_SUITE_P(BackEnds, SolvableProblem, testing::ValuesIn(backends()),
                         [](const auto& info) { return info.param; });

// --- convergence -------------------------------------------------------------------------------

TEST_P(SolvableProblem, MaratosEffect) {
  // Nocedal & Wright 2006, example 15.4, with 10 for 2: on the circle a full step raises both
  // objective and violation. Without a second-order correction it is cut at every iteration, and
  // there are twice as many.
  Statement p;
  const auto x = p.variables({std::cos(0.5), std::sin(0.5)});
  p.minimise(10 * (square(x[1]) + square(x[2]) - 1) - x[1]);
  p.zero(square(x[1]) + square(x[2]) - 1);
  const Answer answer = expect_solved(p, -1);
  EXPECT_LE(answer.iterations, 9);
}

TEST(InteriorPoint, AWarmStartMayLeapAtFirst) {
  // The Maratos effect, so strong that second-order corrections do not mend it: from a point on the
  // circle, with the multiplier of the solution, the search alone takes short steps along it.
  Statement p;
  const auto x = p.variables({std::cos(0.9), std::sin(0.9)});
  p.minimise(1000 * (square(x[1]) + square(x[2]) - 1) - x[1]);
  p.zero(square(x[1]) + square(x[2]) - 1);
  ExpressionProblem problem(p);
  Start start = problem.cold_start();
  Options options;
  options.warm_start = true;
  start.y = {-999.5};
  start.zl = start.zu = {0, 0};
  const Answer answer = make_solver("interior_point")->solve(problem, start, options);
  EXPECT_EQ(answer.status, Status::solved);
  EXPECT_LE(answer.iterations, 6);
}

/// Waechter & Biegler 2000: from starts with x1 < 0 every step that satisfies the linearised
/// equations is cut by x2, x3 >= 0, so that a line search alone converges to (-1, 0, 0), which is
/// not feasible. The second row may be scaled: that does not change those steps.
Statement counterexample(const Vector& start, double row_scale) {
  Statement p;
  const auto x = p.variables(start);
  p.lower({-kInf, 0, 0});
  p.minimise(x[1]);
  p.zero(square(x[1]) - x[2] - 1, "parabola");
  p.zero(row_scale * (x[1] - x[3] - 0.5), "line");
  return p;
}

TEST_P(SolvableProblem, WaechterBieglerCounterexampleIsSolved) {
  for (const Vector& start : {Vector{-2, 3, 1}, Vector{-4, 1, 1}})
    expect_solved(counterexample(start, 4), 1);
}

TEST_P(SolvableProblem, WaechterBieglerCounterexampleMayEndAtItsLeastViolation) {
  // Unscaled, (-1, 0, 0) has locally the least sum of violations: to move x1 by d towards 1 mends
  // "line" by d and breaks "parabola" by 2 d. "Infeasible" is true there, and no other point.
  for (const Vector& start : {Vector{-2, 3, 1}, Vector{-4, 1, 1}}) {
    ExpressionProblem problem(counterexample(start, 1));
    const Answer answer = solve(problem);
    if (answer.status == Status::infeasible) {
      const Residuals residuals = check(problem, answer.point, {});
      EXPECT_NEAR(residuals.violation, 1.5, 1e-3);
      EXPECT_EQ(residuals.worst_constraint, "line");
      EXPECT_NEAR(answer.point.x[0], -1, 1e-3);
    } else {
      EXPECT_EQ(answer.status, Status::solved) << to_string(answer.status);
      EXPECT_NEAR(answer.objective, 1, 1e-6);
    }
  }
}

TEST_P(SolvableProblem, NewtonsMethodDiverges) {
  // Full Newton steps on atan(x) = 0 grow without bound from |x| > 1.39.
  Statement p;
  const auto x = p.variables({10});
  p.zero(atan(x[1]));
  expect_solved(p, 0);
}

// --- degenerate --------------------------------------------------------------------------------

TEST_P(SolvableProblem, DependentEquations) {
  Statement linear;
  auto x = linear.variables({3, -1, 2, 5});
  linear.minimise(square(x[1]) + square(x[2]) + square(x[3] - 1) + square(x[4]));
  linear.zero(x[1] + x[2] - 1);
  linear.zero(2 * x[1] + 2 * x[2] - 2);
  linear.zero(x[1] + x[2] + x[3] - 2);
  expect_solved(linear, 0.5);

  Statement nonlinear;
  x = nonlinear.variables({3, -1, 2, 5});
  nonlinear.minimise(x[1] + square(x[3]) + square(x[4]));
  nonlinear.zero(square(x[1]) + square(x[2]) - 1);
  nonlinear.zero(3 * square(x[1]) + 3 * square(x[2]) - 3);
  expect_solved(nonlinear, -1);
}

TEST_P(SolvableProblem, EquationOfTwoInequalities) {
  // No point is strictly inside both rows: the multipliers are not bounded.
  Statement p;
  const auto x = p.variables({4, -2});
  p.minimise(square(x[1]) + square(x[2]));
  p.nonnegative(x[1] + x[2] - 1);
  p.nonnegative(1 - x[1] - x[2]);
  expect_solved(p, 0.5);
}

TEST_P(SolvableProblem, Complementarity) {
  // x1 x2 <= 0 with x >= 0: no constraint qualification holds at any feasible point.
  for (const bool equation : {false, true}) {
    Statement p;
    const auto x = p.variables({0.6, 0.4});
    p.lower({0});
    p.minimise(square(x[1] - 1) + square(x[2] - 1));
    p.between(equation ? 0 : -kInf, x[1] * x[2], 0, "complementarity");
    expect_solved(p, 1);
  }
}

TEST_P(SolvableProblem, SingularHessianAndManyOptima) {
  Statement p;
  const auto x = p.variables({2, 3, 4});
  p.lower({0});
  p.minimise(pow(x[1] - 1, 4));
  p.between(1, x[2] + x[3], 2);
  expect_solved(p, 0);
}

TEST_P(SolvableProblem, FixedVariables) {
  for (const double start : {1.0, 4.0}) {  // at the fixed value and away from it
    Statement p;
    const auto x = p.variables({start, 5, 5, 1});
    p.lower({1});
    p.upper({1, 5, 5, 5});
    p.minimise(x[1] * x[4] * (x[1] + x[2] + x[3]) + x[3]);
    p.nonnegative(x[1] * x[2] * x[3] * x[4] - 25);
    p.zero(square(x[1]) + square(x[2]) + square(x[3]) + square(x[4]) - 40);
    EXPECT_EQ(expect_solved(p, 17.0140173).point.x[0], 1);
  }
}

TEST_P(SolvableProblem, EverythingFixed) {
  Statement p;
  const auto x = p.variables({2, 3});
  p.lower({2, 3});
  p.upper({2, 3});
  p.minimise(x[1] * x[2]);
  p.nonnegative(x[1] + x[2] - 4, "sum");
  expect_solved(p, 6);
  p.nonnegative(x[1] - 2.5, "first");
  expect_infeasible(p, 0.5, {"first"});
}

TEST_P(SolvableProblem, MoreEquationsThanVariables) {
  for (const double second : {2.0, 3.0}) {  // one solution; none
    Statement p;
    const auto x = p.variables({5});
    p.minimise(x[1]);
    p.zero(x[1] - 1, "one");
    p.zero(2 * x[1] - second, "two");
    ExpressionProblem problem(p);
    const Answer answer = solve(problem);
    // Ipopt counts before it looks; a system without a solution need not be told from one with few.
    if (answer.status == Status::too_few_freedoms && (second == 3 || GetParam() == "ipopt"))
      continue;
    EXPECT_EQ(answer.status, second == 2 ? Status::solved : Status::infeasible)
        << to_string(answer.status);
  }
}

TEST_P(SolvableProblem, NoRows) {
  Statement p;
  const auto x = p.variables({-1.2, 1});
  p.minimise(100 * square(x[2] - square(x[1])) + square(1 - x[1]));
  expect_solved(p, 0);
}

TEST_P(SolvableProblem, OneVariable) {
  Statement free;
  auto x = free.variables({3});
  free.minimise(exp(x[1]) - 2 * x[1]);
  expect_solved(free, 2 - 2 * std::log(2.0));

  Statement bounded;
  x = bounded.variables({0.5});
  bounded.lower({-1});
  bounded.upper({1});
  bounded.minimise(cos(3 * x[1]) + x[1]);                      // the local optimum beside the start
  const double angle = std::numbers::pi - std::asin(1.0 / 3);  // where sin(3 x) = 1/3
  expect_solved(bounded, std::cos(angle) + angle / 3);
}

TEST_P(SolvableProblem, NoObjective) {
  Statement p;
  const auto x = p.variables({3, 4});
  p.zero(square(x[1]) + square(x[2]) - 4);
  p.between(0.1, x[1] * x[2], 0.2);
  expect_solved(p, 0);
}

// --- scaling -----------------------------------------------------------------------------------

TEST_P(SolvableProblem, BadlyScaledVariables) {
  // More, Garbow & Hillstrom 1981, problem 4 (Brown badly scaled)
  Statement p;
  const auto x = p.variables({1, 1});
  p.minimise(square(x[1] - 1e6) + square(x[2] - 2e-6) + square(x[1] * x[2] - 2));
  expect_solved(p, 0);
}

TEST_P(SolvableProblem, BadlyScaledRowsAndObjective) {
  Statement p;
  const auto x = p.variables({1, 5, 5, 1});
  p.lower({1});
  p.upper({5});
  p.minimise(1e4 * (x[1] * x[4] * (x[1] + x[2] + x[3]) + x[3]));
  p.nonnegative(1e-4 * (x[1] * x[2] * x[3] * x[4] - 25));
  p.zero(1e5 * (square(x[1]) + square(x[2]) + square(x[3]) + square(x[4]) - 40));
  ExpressionProblem problem(p);
  const Answer answer = solve(problem);
  EXPECT_EQ(answer.status, Status::solved);
  // A row 1e-4 small is met to 1e-8 / 1e-4 of its own, times a multiplier of .55.
  EXPECT_NEAR(answer.objective / 1e4, 17.0140173, 1e-4);
  EXPECT_LE(check(problem, answer.point, {}).violation, 1e-6);
}

}  // namespace
}  // namespace slalom::nlp
