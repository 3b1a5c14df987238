// The checker believes nothing but the point and the problem's functions.

#include "slalom/nlp/check.hpp"

#include <gtest/gtest.h>

#include "nlp/small_problems.hpp"
#include "slalom/base/error.hpp"

namespace slalom::nlp {
namespace {

Options at_floor(double mu) {
  Options options;
  options.floor = mu;
  return options;
}

Start solution(SmallProblem& problem, const Options& options) {
  auto answer = make_solver()->solve(problem, problem.cold_start(), options);
  EXPECT_EQ(answer.status, Status::solved);
  return answer.point;
}

TEST(Check, AgreesWithDifferencesOfTheProblemsFunctions) {
  auto problem = hs071({2, 1, 0.5, 10}, {0.1, 3});
  const Start point{{0.6, 3.1, 7, 0.2}, {-0.3, 0.2}, {0.1, 0.2, 0.3, 0.4}, {0.5, 0.1, 0.7, 0.2}};
  const auto lagrangian = [&](const Vector& x) {
    Evaluation at;
    problem.evaluate(x, 1, {}, {.values = true}, at);
    double sum = at.objective;
    for (std::size_t r = 0; r < 2; ++r) sum += point.y[r] * at.rows[r];
    for (std::size_t i = 0; i < 4; ++i) sum += x[i] * (point.zu[i] - point.zl[i]);
    return sum;
  };
  double worst = 0;
  std::string name;
  for (std::size_t i = 0; i < 4; ++i) {
    Vector up = point.x, down = point.x;
    const double h = 1e-5;
    up[i] += h;
    down[i] -= h;
    const double slope = (lagrangian(up) - lagrangian(down)) / (2 * h);
    const double size = std::fabs(slope) / problem.structure().variable_scale[i];
    if (size > worst) name = problem.variable_name(i);
    worst = std::max(worst, size);
  }
  const auto residuals = check(problem, point, at_floor(0.5));
  EXPECT_NEAR(residuals.stationarity, worst, 1e-7 * worst);
  EXPECT_EQ(residuals.worst_variable, name);
}

TEST(Check, ViolationIsInTheUsersUnitsAndNamed) {
  auto problem = hs071({2, 1, 0.5, 10}, {0.1, 3});
  // User's values (1.2, 3, 3.5, 2): product 25.2, squares 26.69, so row 2 misses 40 by 18.31.
  const Start point{{0.6, 3, 7, 0.2}, {0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}};
  const auto residuals = check(problem, point, at_floor(0.5));
  EXPECT_NEAR(residuals.violation, 40 - (1.44 + 9 + 12.25 + 4), 1e-12);
  EXPECT_EQ(residuals.worst_constraint, "row 2");
  EXPECT_NEAR(residuals.objective, 1.2 * 2 * 7.7 + 3.5, 1e-12);

  auto outside = point;
  outside.x[3] = 3;  // the user's 30, bound 5
  outside.x[1] = 0;
  EXPECT_EQ(check(problem, outside, at_floor(0.5)).worst_constraint, "row 2");
  auto bound = one_variable(0, 1, 2, 3, 2.5);
  const auto low = check(bound, {{1.25}, {}, {0}, {0}}, {});
  EXPECT_EQ(low.worst_constraint, "x1");
  EXPECT_DOUBLE_EQ(low.violation, 0.75);
}

/// The last digit of 1.5e11 is 3e-5; 1e-6 cannot be asked for, but 1e-2 can.
TEST(Check, RowsAndBoundsAreMetToTheRoundingOfTheirTerms) {
  const Options options = at_floor(0.5);
  auto problem = one_variable(0, 0, -kInf, kInf, 0, 1, 1.5e11, 1.5e11);
  const auto at = [&](double x) { return check(problem, {{x}, {0}, {0}, {0}}, options); };
  const double next = std::nextafter(1.5e11, 2e11);
  EXPECT_EQ(at(next).violation, next - 1.5e11);
  EXPECT_EQ(at(next).violation_beyond_rounding, 0);
  EXPECT_TRUE(at(next).solved(options));
  EXPECT_EQ(at(1.5e11 + 0.01).violation_beyond_rounding, at(1.5e11 + 0.01).violation);
  EXPECT_FALSE(at(1.5e11 + 0.01).solved(options));
  auto fixed = one_variable(0, 0, 1.5e11, 1.5e11, 0);
  EXPECT_TRUE(check(fixed, {{next}, {}, {0}, {0}}, options).solved(options));
  EXPECT_FALSE(check(fixed, {{1.5e11 + 0.01}, {}, {0}, {0}}, options).solved(options));
}

TEST(Check, CatchesEveryTampering) {
  for (const double mu : {0.9, 0.05, 0.0}) {
    Options options = at_floor(mu);
    auto problem = hs071();
    const Start good = solution(problem, options);
    ASSERT_TRUE(check(problem, good, options).solved(options));
    const auto refused = [&](const char* part, std::size_t i, double by, Start bad) {
      EXPECT_FALSE(check(problem, bad, options).solved(options))
          << part << "[" << i << "] by " << by << " at floor " << mu;
    };
    for (const double by : {2e-3, -2e-3})
      for (std::size_t i = 0; i < 4; ++i) {
        Start bad = good;
        bad.x[i] += by;
        refused("x", i, by, bad);
        bad = good;
        bad.zl[i] += by;
        refused("zl", i, by, bad);
        bad = good;
        bad.zu[i] += by;
        refused("zu", i, by, bad);
        if (i >= 2) continue;
        bad = good;
        bad.y[i] += by;
        refused("y", i, by, bad);
      }
  }
}

TEST(Check, NamesTheWorst) {
  const Options options = at_floor(0.9);
  auto problem = hs071();
  const Start good = solution(problem, options);
  Start bad = good;
  bad.zu[2] *= 1.5;
  auto residuals = check(problem, bad, options);
  EXPECT_EQ(residuals.worst_pair, "x3");
  EXPECT_EQ(residuals.worst_variable, "x3");
  EXPECT_NEAR(residuals.complementarity, 0.5, 0.02);
  bad = good;
  bad.y[0] *= 0.5;
  residuals = check(problem, bad, options);
  EXPECT_EQ(residuals.worst_pair, "row 1");
  EXPECT_NEAR(residuals.complementarity, 0.5, 0.02);
}

TEST(Check, TwoSidedRowsAreJudgedByTheDifferenceOfTheirMultipliers) {
  // x between -1 and 1 at 0.5: mu/su - mu/sl = 0.9 (2 - 2/3) = 1.2; 1 % of mu/su + mu/sl is 0.024.
  auto problem = one_variable(-1.2, 0, -kInf, kInf, 0, 1, -1, 1);
  const Options options = at_floor(0.9);
  const auto centrality = [&](double y) {
    return check(problem, {{0.5}, {y}, {0}, {0}}, options).complementarity;
  };
  EXPECT_NEAR(centrality(1.2), 0, 1e-12);
  EXPECT_NEAR(centrality(1.224), 0.01, 1e-5);
  EXPECT_NEAR(centrality(1.176), 0.01, 1e-5);
  EXPECT_NEAR(centrality(-1.2), 1, 1e-5);
}

TEST(Check, ATwoSidedRowMayBeWithinItsToleranceOfALimit) {
  // mu / su - mu / sl = 1e-3 (1 - 1e7) = y at 1e-7.
  auto problem = one_variable(1e4, 0, -kInf, kInf, 0, 1, 0, 1);
  const Options options = at_floor(1e-3);
  const auto centrality = [&](double x) {
    return check(problem, {{x}, {1e-3 - 1e4}, {0}, {0}}, options).complementarity;
  };
  EXPECT_NEAR(centrality(1e-7), 0, 1e-9);
  EXPECT_NEAR(centrality(-1e-7), 0, 1e-9);
  EXPECT_EQ(centrality(-2e-6), kInf);
}

TEST(Check, WrongSignsAreNoOptimum) {
  const Options options;
  // max x^2/2 with x <= 2 written as a row: x = 2, y = 2. With x >= 2 instead that y is wrong.
  auto upper = one_variable(0, -1, -kInf, kInf, 1, 1, -kInf, 2);
  EXPECT_TRUE(check(upper, {{2}, {2}, {0}, {0}}, options).solved(options));
  auto lower = one_variable(0, -1, -kInf, kInf, 1, 1, 2, kInf);
  EXPECT_FALSE(check(lower, {{2}, {2}, {0}, {0}}, options).solved(options));
  auto bound = one_variable(0, -1, 2, kInf, 3);
  EXPECT_FALSE(check(bound, {{2}, {}, {-2}, {0}}, options).solved(options));
  EXPECT_FALSE(check(bound, {{2}, {}, {0}, {2}}, options).solved(options)) << "no upper side";
  EXPECT_FALSE(check(bound, {{2}, {}, {0}, {2}}, at_floor(.5)).solved(at_floor(.5)));
}

TEST(Check, FixedVariablesMustStandAtTheirValue) {
  auto problem = one_variable(1, 0, 3, 3, 3);
  const Options options;
  EXPECT_TRUE(check(problem, {{3}, {}, {0}, {0}}, options).solved(options));
  const auto moved = check(problem, {{3.01}, {}, {0}, {0}}, options);
  EXPECT_FALSE(moved.solved(options));
  EXPECT_EQ(moved.worst_constraint, "x1");
}

TEST(Check, NotANumberIsNeverSolved) {
  const Options options = at_floor(0.9);
  auto problem = hs071();
  const Start good = solution(problem, options);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Options& each : {options, Options()}) {
    const Start solved = solution(problem, each);
    for (auto part : {&Start::x, &Start::y, &Start::zl, &Start::zu})
      for (std::size_t i = 0; i < (solved.*part).size(); ++i) {
        Start bad = solved;
        (bad.*part)[i] = nan;
        const auto residuals = check(problem, bad, each);
        EXPECT_FALSE(residuals.solved(each)) << i << " at a floor of " << each.floor;
        EXPECT_FALSE(residuals.complementarity <= 1 && residuals.stationarity <= 1) << i;
      }
  }
  const auto rows = problem.rows;
  problem.rows = [&](const Vector& x) {
    auto g = rows(x);
    g[0] = nan;
    return g;
  };
  const auto residuals = check(problem, good, options);
  EXPECT_FALSE(residuals.solved(options));
  EXPECT_EQ(residuals.worst_constraint, "row 1");

  problem.fault = [](const Vector&) { return Fault{"dynamics of v", "node 1", ""}; };
  const auto faulty = check(problem, good, options);
  EXPECT_FALSE(faulty.solved(options));
  EXPECT_EQ(faulty.fault.function, "dynamics of v");
}

TEST(Check, PointOfAnotherSizeIsRefused) {
  auto problem = hs071();
  EXPECT_THROW((void)check(problem, {{1, 1}, {0, 0}, {}, {}}, {}), InvalidValue);
  EXPECT_THROW((void)check(problem, {{1, 1, 1, 1}, {}, {}, {}}, {}), InvalidValue);
}

}  // namespace
}  // namespace slalom::nlp
