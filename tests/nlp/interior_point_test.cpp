// The interior-point method: each way it can end, and the same answers as Ipopt's.

#include <gtest/gtest.h>

#include "nlp/small_problems.hpp"
#include "slalom/nlp/check.hpp"

namespace slalom::nlp {
namespace {

Answer solve(Problem& problem, const Start& start, const Options& options = {}) {
  return make_solver("interior_point")->solve(problem, start, options);
}

TEST(InteriorPoint, SolvesHs071) {
  auto problem = hs071();
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::solved);
  EXPECT_EQ(answer.backend, "interior_point/stage_ldlt");
  EXPECT_NEAR(answer.objective, 17.0140173, 1e-6);
  const Vector expected{1, 4.7429994, 3.8211503, 1.3794082};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(answer.point.x[i], expected[i], 1e-6);
  EXPECT_NEAR(answer.point.y[0], -0.5522937, 1e-5);
  EXPECT_NEAR(answer.point.y[1], 0.1614686, 1e-5);
  EXPECT_NEAR(answer.point.zl[0], 1.0878712, 1e-5);
}

TEST(InteriorPoint, ScaledProblemHasTheSameSolution) {
  auto problem = hs071({10, 0.1, 3, 1}, {0.01, 7});
  const Answer answer = solve(problem, problem.cold_start());
  ASSERT_EQ(answer.status, Status::solved);
  EXPECT_NEAR(answer.objective, 17.0140173, 1e-6);
}

TEST(InteriorPoint, EndsAtTheCentralPointOfTheFloor) {
  auto problem = one_variable(2, 0, 0, kInf, 5);  // min 2 x - mu log x: x = mu / 2
  Options options;
  options.floor = 0.5;
  const Answer answer = solve(problem, problem.cold_start(), options);
  ASSERT_EQ(answer.status, Status::solved);
  EXPECT_NEAR(answer.point.x[0], 0.25, 0.25 * options.floor_tol);
  EXPECT_TRUE(check(problem, answer.point, options).solved(options));
}

TEST(InteriorPoint, AgreesWithIpoptAtAFloor) {
  Options options;
  options.floor = 0.1;
  auto problem = hs071();
  const Answer ours = solve(problem, problem.cold_start(), options);
  ASSERT_EQ(ours.status, Status::solved);
  const auto residuals = check(problem, ours.point, options);
  EXPECT_TRUE(residuals.solved(options));
  const auto names = backends();
  if (std::find(names.begin(), names.end(), "ipopt") == names.end()) GTEST_SKIP() << "needs Ipopt";
  const Answer theirs = make_solver("ipopt")->solve(problem, problem.cold_start(), options);
  EXPECT_NEAR(residuals.phi, check(problem, theirs.point, options).phi, 1e-4);
}

TEST(InteriorPoint, WarmStartAtTheAnswerTakesFewIterations) {
  Options options;
  options.floor = 0.1;
  auto problem = hs071();
  const Answer cold = solve(problem, problem.cold_start(), options);
  options.warm_start = true;
  const Answer warm = solve(problem, cold.point, options);
  EXPECT_EQ(warm.status, Status::solved);
  EXPECT_LE(warm.iterations, 2);
  EXPECT_LT(warm.iterations, cold.iterations);
}

TEST(InteriorPoint, IterationLimit) {
  auto problem = hs071();
  Options options;
  options.max_iterations = 2;
  const Answer answer = solve(problem, problem.cold_start(), options);
  EXPECT_EQ(answer.status, Status::iteration_limit);
  EXPECT_EQ(answer.iterations, 2);
}

TEST(InteriorPoint, TimeLimit) {
  auto problem = hs071();
  Options options;
  options.time_limit = 1e-9;
  EXPECT_EQ(solve(problem, problem.cold_start(), options).status, Status::time_limit);
}

TEST(InteriorPoint, Interrupted) {
  auto problem = hs071();
  Options options;
  options.stop = [](void*) { return true; };
  EXPECT_EQ(solve(problem, problem.cold_start(), options).status, Status::interrupted);
}

TEST(InteriorPoint, ALooseToleranceIsMetToo) {
  auto problem = hs071();
  Options options;
  options.tol = 1e-2;
  const Answer answer = solve(problem, problem.cold_start(), options);
  EXPECT_EQ(answer.status, Status::solved) << answer.message;
  EXPECT_NEAR(answer.objective, 17.0140173, 1e-1);
}

TEST(InteriorPoint, InfeasibleEndsWithTheLeastViolation) {
  auto problem = one_variable(1, 0, 0, 10, 1, 1, 20, kInf);  // x >= 20 and x <= 10
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::infeasible);
  EXPECT_NEAR(answer.point.x[0], 10, 1e-3);
}

TEST(InteriorPoint, InvalidNumberNamesTheFunction) {
  auto problem = hs071();
  problem.fault = [](const Vector&) { return Fault{"the objective", "node 0", ""}; };
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::invalid_number);
  EXPECT_EQ(answer.fault.function, "the objective");
}

}  // namespace
}  // namespace slalom::nlp
