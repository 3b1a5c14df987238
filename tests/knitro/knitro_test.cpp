// The calls of the KNITRO back end, against a stub of its library.

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/nlp/backends.hpp"
#include "nlp/expression_problem.hpp"
#include "nlp/small_problems.hpp"
#include "slalom/base/error.hpp"
#include "slalom/nlp/check.hpp"
#include "stub.hpp"

namespace slalom::nlp {
namespace {

class Knitro : public testing::Test {
 protected:
  Knitro() { KnitroStub::get() = {}; }
  ~Knitro() override { EXPECT_EQ(stub.contexts, 0); }
  static Answer solve(Problem& problem, const Start& start, const Options& options = {}) {
    return make_knitro()->solve(problem, start, options);
  }
  KnitroStub& stub = KnitroStub::get();
};

/// Strictly convex with two equations; bounds that do not act.
ExpressionProblem curved() {
  Statement s;
  const auto x = s.variables({1, 1, 1});
  s.minimise(square(x[1]) + square(x[2] - x[3]) + exp(x[1]) + square(x[3]));
  s.zero(x[1] + 2 * x[2] - 3);
  s.between(2, 0.1 * square(x[1]) + x[3], 2);
  s.lower({-kInf, -10, -kInf});
  s.upper({50, kInf, kInf});
  return ExpressionProblem(s);
}

TEST_F(Knitro, SolvesByItsCallbacksWithOurSigns) {
  auto problem = curved();
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::solved) << answer.message;
  EXPECT_EQ(answer.backend, "knitro");
  EXPECT_GT(answer.iterations, 1);
  EXPECT_TRUE(check(problem, answer.point, {}).solved({}));
  const auto ours = make_solver()->solve(problem, problem.cold_start(), Options{});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(answer.point.x[i], ours.point.x[i], 1e-6);
  for (std::size_t r = 0; r < 2; ++r) EXPECT_NEAR(answer.point.y[r], ours.point.y[r], 1e-6);
}

TEST_F(Knitro, IsToldBoundsOptionsAndStart) {
  auto problem = curved();
  Options options;
  options.warm_start = true;
  options.tol = 1e-7;
  options.max_iterations = 40;
  const Start start{{1, 1, 1}, {0.5, -0.25}, {0, 2, 0}, {3, 0, 0}};
  EXPECT_EQ(solve(problem, start, options).status, Status::solved);
  EXPECT_EQ(stub.xl, (Vector{-1e20, -10, -1e20}));
  EXPECT_EQ(stub.xu, (Vector{50, 1e20, 1e20}));
  EXPECT_EQ(stub.gl, (Vector{0, 2}));
  EXPECT_EQ(stub.gu, (Vector{0, 2}));
  EXPECT_EQ(stub.x, start.x);
  EXPECT_EQ(stub.y, start.y);
  EXPECT_EQ(stub.z, (Vector{3, -2, 0}));
  EXPECT_EQ(stub.parameters.at("opttol"), 1e-7);
  EXPECT_EQ(stub.parameters.at("maxit"), 40);
  EXPECT_EQ(stub.parameters.at("outlev"), 0);
  EXPECT_EQ(stub.parameters.at("strat_warm_start"), 1);
}

TEST_F(Knitro, ReturnCodesAreStatuses) {
  const std::pair<int, Status> cases[] = {
      {-100, Status::numerical_failure}, {-200, Status::infeasible},
      {-300, Status::unbounded},         {-401, Status::time_limit},
      {-411, Status::time_limit},        {-402, Status::iteration_limit},
      {-500, Status::numerical_failure}, {-502, Status::invalid_number}};
  auto problem = curved();
  for (const auto& [code, status] : cases) {
    stub.result = code;
    EXPECT_EQ(solve(problem, problem.cold_start()).status, status) << code;
  }
}

TEST_F(Knitro, StopsWhenAskedAndNamesFaults) {
  auto problem = curved();
  Options options;
  options.stop = [](void*) { return true; };
  EXPECT_EQ(solve(problem, problem.cold_start(), options).status, Status::interrupted);
  Options hurried;
  hurried.time_limit = 0;
  EXPECT_EQ(solve(problem, problem.cold_start(), hurried).status, Status::time_limit);
  Options none;
  none.max_iterations = 0;
  EXPECT_EQ(solve(problem, problem.cold_start(), none).status, Status::iteration_limit);
  Statement s;
  const auto x = s.variables({-1.0});
  s.minimise(log(x[1]));
  ExpressionProblem bad(s);
  const auto answer = solve(bad, bad.cold_start());
  EXPECT_EQ(answer.status, Status::invalid_number);
  EXPECT_EQ(answer.fault.function, "objective");
}

TEST_F(Knitro, SaysWhenItHasNoLicenceOrIsAskedForAFloor) {
  auto problem = curved();
  stub.licence = false;
  try {
    (void)solve(problem, problem.cold_start());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("licence"), std::string::npos);
  }
  Options floor;
  floor.floor = 1;
  EXPECT_THROW((void)solve(problem, problem.cold_start(), floor), InvalidValue);
}

}  // namespace
}  // namespace slalom::nlp
