// At a barrier floor mu the answer is the central point of mu, here known in closed form.

#include <gtest/gtest.h>

#include "nlp/small_problems.hpp"
#include "slalom/nlp/check.hpp"

namespace slalom::nlp {
namespace {

struct Solved {
  Answer answer;
  Residuals residuals;
  double x() const { return answer.point.x[0]; }
};

/// By every back end of this build that stops at a floor; they agree.
Solved central_point(SmallProblem& problem, double mu) {
  Options options;
  options.floor = mu;
  Solved first;
  for (const auto& backend : backends()) {
    if (!stops_at_floor(backend)) continue;
    SCOPED_TRACE(backend);
    Solved solved;
    solved.answer = make_solver(backend)->solve(problem, problem.cold_start(), options);
    solved.residuals = check(problem, solved.answer.point, options);
    EXPECT_EQ(solved.answer.status, Status::solved);
    EXPECT_TRUE(solved.residuals.solved(options));
    if (first.answer.point.x.empty()) first = solved;
    for (std::size_t i = 0; i < problem.start.size(); ++i)
      EXPECT_NEAR(solved.answer.point.x[i], first.answer.point.x[i], 0.02);
    EXPECT_NEAR(solved.residuals.phi, first.residuals.phi, 1e-4 * (1 + mu));
  }
  return first;
}

constexpr double kFloors[] = {0.01, 0.3, 0.9, 5};

TEST(Floor, LowerBound) {
  for (const double mu : kFloors) {
    auto problem = one_variable(2, 0, 1, kInf, 4);  // min 2x, x >= 1: 2 = mu / (x - 1)
    const auto solved = central_point(problem, mu);
    EXPECT_NEAR(solved.x(), 1 + mu / 2, 0.01 * mu);
    EXPECT_NEAR(solved.answer.point.zl[0], 2, 1e-3);
    EXPECT_NEAR(solved.residuals.phi, 2 * solved.x() - mu * std::log(solved.x() - 1), 1e-12);
  }
}

TEST(Floor, UpperBound) {
  for (const double mu : kFloors) {
    auto problem = one_variable(-1, 0, -kInf, 3, 0);
    const auto solved = central_point(problem, mu);
    EXPECT_NEAR(solved.x(), 3 - mu, 0.01 * mu);
    EXPECT_NEAR(solved.answer.point.zu[0], 1, 1e-3);
  }
}

/// min c x between -1 and 1: c = mu/(1 + x) - mu/(1 - x).
double between(double c, double mu) {
  return c == 0 ? 0 : (mu - std::sqrt(mu * mu + c * c)) / c;
}

TEST(Floor, TwoSidedBounds) {
  for (const double mu : kFloors)
    for (const double c : {-1.0, 0.0, 2.0}) {
      auto problem = one_variable(c, 0, -1, 1, 0.5);
      EXPECT_NEAR(central_point(problem, mu).x(), between(c, mu), 0.01) << mu << " " << c;
    }
}

TEST(Floor, OneSidedRow) {
  for (const double mu : kFloors) {
    auto problem = one_variable(1, 0, -kInf, kInf, 4, 2, 6, kInf);  // 2 x >= 6
    const auto solved = central_point(problem, mu);
    EXPECT_NEAR(solved.x(), 3 + mu, 0.01 * mu + 1e-6);
    EXPECT_NEAR(solved.answer.point.y[0], -0.5, 1e-3);
  }
}

TEST(Floor, TwoSidedRow) {
  for (const double mu : kFloors)
    for (const double c : {-1.0, 2.0}) {
      auto problem = one_variable(c, 0, -kInf, kInf, 0.5, 1, -1, 1);
      const auto solved = central_point(problem, mu);
      EXPECT_NEAR(solved.x(), between(c, mu), 0.01);
      EXPECT_NEAR(solved.answer.point.y[0], -c, 2e-3);
    }
}

TEST(Floor, ScaledRowHasTheSameCentralPoint) {
  for (const double scale : {0.01, 1.0, 100.0}) {
    auto problem = one_variable(1, 1, -kInf, kInf, 4, 1, 1, kInf);
    problem.finish({1 / scale}, {scale});
    Options options;
    options.floor = 0.5;
    options.floor_tol = 1e-3;  // 1 % of mu is 0.002 in x
    const auto answer = make_solver()->solve(problem, problem.cold_start(), options);
    ASSERT_EQ(answer.status, Status::solved);
    // 1 + x = mu / (x - 1)
    EXPECT_NEAR(answer.point.x[0] / scale, std::sqrt(1.5), 1e-3);
    EXPECT_TRUE(check(problem, answer.point, options).solved(options));
  }
}

TEST(Floor, IsReachedInTheUsersUnits) {
  for (const double unit : {1e-4, 1e4}) {
    auto problem = hs071({unit, 1, 1 / unit, 1}, {1e-4, 1});
    Options options;
    options.floor = 0.01;
    const auto answer =
        make_solver("interior_point")->solve(problem, problem.cold_start(), options);
    ASSERT_EQ(answer.status, Status::solved) << unit;
    EXPECT_TRUE(check(problem, answer.point, options).solved(options)) << unit;
  }
}

TEST(Floor, EquationsHaveNoBarrierAndTheLagrangiansSign) {
  // min x^2/2 + w, x w = 3, x and w >= 0: x + y w = mu/x and 1 + y x = mu/w.
  SmallProblem p;
  p.objective = [](const Vector& x) { return 0.5 * x[0] * x[0] + x[1]; };
  p.gradient = [](const Vector& x) { return Vector{x[0], 1}; };
  p.rows = [](const Vector& x) { return Vector{x[0] * x[1]}; };
  p.jacobian = [](const Vector& x) { return Vector{x[1], x[0]}; };
  p.hessian = [](const Vector&, double s, const Vector& y) { return Vector{s, y[0], 0}; };
  p.bounds = {{0, 0}, {kInf, kInf}, {3}, {3}};
  p.start = {1, 1};
  p.finish();
  const double mu = 0.9;
  const auto solved = central_point(p, mu);
  const double x = solved.x(), w = solved.answer.point.x[1], y = solved.answer.point.y[0];
  EXPECT_NEAR(x * w, 3, 1e-6);
  EXPECT_LT(y, 0);
  EXPECT_NEAR(x + y * w, mu / x, 0.02 * mu / x);
  EXPECT_NEAR(1 + y * x, mu / w, 0.02 * mu / w);
  // The barrier of x w = 3 is constant, so that the optimum without a floor is the same point.
  EXPECT_NEAR(x, std::cbrt(3), 2e-2);
}

TEST(Floor, Hs071ObjectiveRisesWithTheFloor) {
  double last = 0;
  for (const double mu : {0.0, 0.01, 0.1, 1.0}) {
    auto problem = hs071();
    const auto solved = central_point(problem, mu);
    EXPECT_GT(solved.answer.objective, last) << mu;
    last = solved.answer.objective;
  }
}

/// Distances between planets in metres, in a chain of linear rows: of 1.5e11 m the rounding is 3e-5
/// m. Scaled, a row is met as well as numbers can meet it by any method that ends with a full step.
SmallProblem chain_in_metres() {
  constexpr std::size_t kSize = 9;
  constexpr double kUnit = 1e11;
  SmallProblem p;
  const auto share = [](std::size_t i) { return 0.7 + 0.1234567 * static_cast<double>(i); };
  p.objective = [](const Vector& x) {
    double sum = 0;
    for (std::size_t i = 0; i < kSize; ++i) sum += std::pow(x[i] / kUnit - 1.5, 2);
    return sum;
  };
  p.gradient = [](const Vector& x) {
    Vector slope;
    for (const double each : x) slope.push_back(2 * (each / kUnit - 1.5) / kUnit);
    return slope;
  };
  p.hessian = [](const Vector&, double s, const Vector&) {
    Vector h;
    for (std::size_t i = 0; i < kSize; ++i)
      for (std::size_t j = 0; j <= i; ++j) h.push_back(i == j ? 2 * s / (kUnit * kUnit) : 0);
    return h;
  };
  p.rows = [share](const Vector& x) {
    Vector rows;
    for (std::size_t i = 0; i + 1 < kSize; ++i) rows.push_back(x[i] - share(i) * x[i + 1]);
    return rows;
  };
  p.jacobian = [share](const Vector&) {
    Vector j((kSize - 1) * kSize, 0.0);
    for (std::size_t i = 0; i + 1 < kSize; ++i) {
      j[i * kSize + i] = 1;
      j[i * kSize + i + 1] = -share(i);
    }
    return j;
  };
  p.bounds = {Vector(kSize, 0.3 * kUnit), Vector(kSize, 9 * kUnit), Vector(kSize - 1, 0.0123e11),
              Vector(kSize - 1, 0.0123e11)};
  p.start.assign(kSize, 2 * kUnit);
  p.finish(Vector(kSize, kUnit), Vector(kSize - 1, 1 / kUnit));
  return p;
}

/// By every back end: the check allows what the solver may end with.
TEST(Floor, RowsOfLargeNumbersAreMetToTheirRounding) {
  auto problem = chain_in_metres();
  const auto solved = central_point(problem, 1e-3);
  EXPECT_GT(solved.residuals.violation, Options().constraint_tol) << "else nothing is tested";
  EXPECT_LE(solved.residuals.violation_beyond_rounding, Options().constraint_tol);
}

}  // namespace
}  // namespace slalom::nlp
