// One test for each way a solve can end, of every back end.

#include <gtest/gtest.h>

#include <cmath>

#include "nlp/small_problems.hpp"
#include "slalom/base/error.hpp"

namespace slalom::nlp {
namespace {

class BackEnd : public testing::TestWithParam<std::string> {
 protected:
  static Answer solve(Problem& problem, const Start& start, const Options& options = {}) {
    return make_solver(GetParam())->solve(problem, start, options);
  }
};
INSTANTIATE_TEST_SUITE_P(All, BackEnd, testing::ValuesIn(backends()),
                         [](const auto& info) { return info.param; });

TEST_P(BackEnd, SolvedIsTheKnownOptimumWithItsMultipliers) {
  auto problem = hs071();
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::solved);
  EXPECT_EQ(answer.backend.substr(0, answer.backend.find('/')), GetParam());
  EXPECT_FALSE(answer.message.empty());
  EXPECT_FALSE(answer.fault);
  EXPECT_NEAR(answer.objective, 17.0140173, 1e-7);
  const Vector expected{1, 4.7429994, 3.8211503, 1.3794082};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(answer.point.x[i], expected[i], 1e-6);
  EXPECT_NEAR(answer.point.y[0], -0.5522937, 1e-6);  // at its lower side: y < 0
  EXPECT_NEAR(answer.point.y[1], 0.1614686, 1e-6);
  EXPECT_NEAR(answer.point.zl[0], 1.0878712, 1e-6);
  EXPECT_GT(answer.iterations, 3);
  EXPECT_GT(answer.wall_s, 0);
}

TEST_P(BackEnd, SolvedWhateverTheScales) {
  auto problem = hs071({10, 0.1, 3, 1}, {0.01, 7});
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::solved) << answer.message;
  EXPECT_NEAR(answer.objective, 17.0140173, 1e-6);
}

TEST_P(BackEnd, SolvedToALooseTolerance) {
  auto problem = hs071();
  Options options;
  options.tol = 1e-2;
  const Answer answer = solve(problem, problem.cold_start(), options);
  EXPECT_EQ(answer.status, Status::solved) << answer.message;
  EXPECT_NEAR(answer.objective, 17.0140173, 1e-1);
}

TEST_P(BackEnd, SolvedWhereTheObjectiveIsSteep) {
  auto problem = hs071();
  constexpr double kSteep = 1e8;
  problem.objective = [f = problem.objective](const Vector& x) { return kSteep * f(x); };
  problem.gradient = [g = problem.gradient](const Vector& x) {
    Vector slope = g(x);
    for (double& s : slope) s *= kSteep;
    return slope;
  };
  problem.hessian = [h = problem.hessian](const Vector& x, double sigma, const Vector& y) {
    return h(x, kSteep * sigma, y);
  };
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::solved) << answer.message;
  EXPECT_NEAR(answer.objective / kSteep, 17.0140173, 1e-6);
}

TEST_P(BackEnd, TakesOverBoundsThatWereNotThere) {
  auto problem = one_variable(-1, 1, -kInf, kInf, 0);  // least at 1
  problem.id = 77;
  const auto solver = make_solver(GetParam());
  for (const double upper : {kInf, 0.5, kInf, 0.25}) {
    problem.bounds.xu = {upper};
    problem.finish();
    const Answer answer = solver->solve(problem, problem.cold_start(), {});
    EXPECT_EQ(answer.status, Status::solved) << answer.message;
    EXPECT_NEAR(answer.point.x[0], std::min(1.0, upper), 1e-6);
  }
}

TEST_P(BackEnd, StartsAtTheAnswersOwnPoint) {
  auto problem = hs071();
  const auto solver = make_solver(GetParam());
  Answer answer = solver->solve(problem, problem.cold_start(), {});
  for (const bool warm : {false, true}) {
    Options options;
    options.warm_start = warm;
    solver->solve(problem, answer.point, options, answer);
    EXPECT_EQ(answer.status, Status::solved) << answer.message;
    EXPECT_NEAR(answer.objective, 17.0140173, 1e-6);
  }
}

TEST_P(BackEnd, SolvedWhenEquationsFixEverything) {
  auto problem = one_variable(1, 0, -kInf, kInf, 5, 2, 6, 6);  // 2 x = 6: as many rows as unknowns
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::solved) << answer.message;
  EXPECT_NEAR(answer.point.x[0], 3, 1e-7);
}

TEST_P(BackEnd, IterationLimit) {
  auto problem = hs071();
  Options options;
  options.max_iterations = 2;
  const Answer answer = solve(problem, problem.cold_start(), options);
  EXPECT_EQ(answer.status, Status::iteration_limit);
  EXPECT_EQ(answer.iterations, 2);
  EXPECT_EQ(answer.point.x.size(), 4u);
}

TEST_P(BackEnd, TimeLimit) {
  auto problem = hs071();
  Options options;
  options.time_limit = 1e-9;
  const Answer answer = solve(problem, problem.cold_start(), options);
  EXPECT_EQ(answer.status, Status::time_limit);
  EXPECT_LE(answer.iterations, 1);
}

TEST_P(BackEnd, InfeasibleIsAtThePointOfLeastViolation) {
  auto problem = one_variable(1, 0, 0, 10, 1, 1, 20, kInf);  // x >= 20 and x <= 10
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::infeasible) << answer.message;
  EXPECT_NEAR(answer.point.x[0], 10, 1e-3) << "the point of least violation";
}

TEST_P(BackEnd, Unbounded) {
  auto problem = one_variable(-1, 0, 0, kInf, 1);
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::unbounded) << answer.message;
}

TEST_P(BackEnd, InvalidNumberSaysWhere) {
  auto problem = hs071();
  problem.fault = [](const Vector&) { return Fault{"dynamics of v", "node 3", "ux"}; };
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::invalid_number);
  EXPECT_EQ(answer.fault.function, "dynamics of v");
  EXPECT_EQ(answer.fault.where, "node 3");
  EXPECT_EQ(answer.fault.variable, "ux");
  EXPECT_EQ(answer.point.x, problem.start) << "the start is handed back";
  EXPECT_EQ(answer.point.y.size(), 2u);
}

TEST_P(BackEnd, AFaultSteppedBackFromIsForgiven) {
  // min -log(x) + 2 x from x = 10: the first Newton step leaves the domain.
  SmallProblem p;
  bool faulted = false;
  p.objective = [](const Vector& x) { return -std::log(x[0]) + 2 * x[0]; };
  p.gradient = [](const Vector& x) { return Vector{-1 / x[0] + 2}; };
  p.hessian = [](const Vector& x, double s, const Vector&) { return Vector{s / (x[0] * x[0])}; };
  p.fault = [&](const Vector& x) {
    faulted = faulted || x[0] <= 0;
    return x[0] <= 0 ? Fault{"log", "x", ""} : Fault{};
  };
  p.bounds = {{-kInf}, {kInf}, {}, {}};
  p.start = {10};
  p.finish();
  const Answer answer = solve(p, p.cold_start());
  EXPECT_TRUE(faulted);
  EXPECT_EQ(answer.status, Status::solved);
  EXPECT_FALSE(answer.fault);
  EXPECT_NEAR(answer.point.x[0], 0.5, 1e-6);

  Options options;
  options.max_iterations = answer.iterations - 1;
  const Answer cut = solve(p, p.cold_start(), options);
  EXPECT_EQ(cut.status, Status::iteration_limit);
  EXPECT_FALSE(cut.fault) << "the fault was iterations ago";
}

TEST_P(BackEnd, TooFewFreedoms) {
  SmallProblem p = one_variable(1, 0, -kInf, kInf, 1, 1, 1, 1);
  p.rows = [](const Vector& x) { return Vector{x[0], x[0]}; };
  p.jacobian = [](const Vector&) { return Vector{1, 1}; };
  p.bounds.gl = p.bounds.gu = {1, 2};
  p.finish();
  const Answer answer = solve(p, p.cold_start());
  EXPECT_EQ(answer.status, Status::too_few_freedoms) << answer.message;
}

TEST_P(BackEnd, InterruptedIsWhatThePollStops) {
  auto problem = hs071();
  int polls = 0;
  Options options;
  options.stop = [](void* data) { return ++*static_cast<int*>(data) == 3; };
  options.stop_data = &polls;
  const Answer answer = solve(problem, problem.cold_start(), options);
  EXPECT_EQ(answer.status, Status::interrupted);
  EXPECT_EQ(polls, 3) << "once an iteration, never after it said yes";
}

TEST_P(BackEnd, NumericalFailure) {
  // Second derivatives without bound: the linear systems can be solved no more.
  auto problem = hs071();
  problem.hessian = [](const Vector&, double, const Vector&) { return Vector(10, 1e300); };
  const Answer answer = solve(problem, problem.cold_start());
  EXPECT_EQ(answer.status, Status::numerical_failure) << answer.message;
}

TEST(Status, EachHasItsOwnName) {
  const Status all[] = {
      Status::solved,           Status::iteration_limit, Status::time_limit,
      Status::infeasible,       Status::unbounded,       Status::invalid_number,
      Status::too_few_freedoms, Status::interrupted,     Status::numerical_failure};
  std::vector<std::string> names;
  for (const Status status : all) {
    EXPECT_EQ(std::count(names.begin(), names.end(), to_string(status)), 0);
    names.emplace_back(to_string(status));
  }
  EXPECT_STREQ(to_string(Status::too_few_freedoms), "too_few_freedoms");
}

TEST(Solver, UnknownBackEndIsRefusedWithThoseThereAre) {
  try {
    (void)make_solver("simplex");
    FAIL() << "accepted";
  } catch (const InvalidValue& e) {
    EXPECT_NE(std::string(e.what()).find("'simplex'"), std::string::npos) << e.what();
    for (const auto& name : backends())
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
  }
  EXPECT_FALSE(backends().empty());
}

TEST(Solver, TheDefaultIsInEveryBuild) {
  auto problem = hs071();
  const Answer answer = make_solver()->solve(problem, problem.cold_start(), {});
  EXPECT_EQ(answer.status, Status::solved);
  EXPECT_EQ(answer.backend, "interior_point/stage_ldlt");
}

TEST_P(BackEnd, StartOfAnotherSizeIsRefused) {
  auto problem = hs071();
  EXPECT_THROW((void)solve(problem, {{1, 2}, {}, {}, {}}), InvalidValue);
  Options warm;
  warm.warm_start = true;
  EXPECT_THROW((void)solve(problem, problem.cold_start(), warm), InvalidValue)
      << "a warm start without multipliers";
}

TEST(Solver, OptionsOutOfTheirRangeAreRefused) {
  auto problem = hs071();
  const auto message = [&](auto set) -> std::string {
    Options options;
    set(options);
    try {
      (void)make_solver()->solve(problem, problem.cold_start(), options);
    } catch (const InvalidValue& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message([](Options& o) { o.tol = 0; }).find("tol = 0"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.floor = -1; }).find("floor = -1"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.floor_tol = NAN; }).find("floor_tol"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.time_limit = -1; }).find("time_limit"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.max_iterations = -1; }).find("max_iterations"),
            std::string::npos);
  EXPECT_EQ(message([](Options&) {}), "");
}

TEST_P(BackEnd, WarmStartTakesFewerIterations) {
  auto problem = hs071();
  for (const double floor : {0.0, 0.1}) {
    if (floor > 0 && !stops_at_floor(GetParam())) continue;
    Options options;
    options.floor = floor;
    const Answer cold = solve(problem, problem.cold_start(), options);
    ASSERT_EQ(cold.status, Status::solved);
    options.warm_start = true;
    const Answer warm = solve(problem, cold.point, options);
    EXPECT_EQ(warm.status, Status::solved);
    EXPECT_LT(warm.iterations, cold.iterations / 2) << "floor " << floor;
    EXPECT_NEAR(warm.objective, cold.objective, 1e-5);
  }
}

TEST(Solver, AWarmStartAtACentralPointTakesTwoIterationsAtMost) {
  auto problem = hs071();
  Options options;
  options.floor = 0.1;
  const Answer cold = make_solver()->solve(problem, problem.cold_start(), options);
  options.warm_start = true;
  const Answer warm = make_solver()->solve(problem, cold.point, options);
  EXPECT_EQ(warm.status, Status::solved);
  EXPECT_LE(warm.iterations, 2);
}

TEST(Solver, AnswersWithTheLeastOfFeasibleIteratesWhenItIsCutShort) {
  constexpr std::size_t kMany = 100;
  SmallProblem problem;
  problem.objective = [](const Vector& x) {
    double sum = 0;
    for (const double each : x) sum += 0.5 * (each - 0.9) * (each - 0.9);
    return sum;
  };
  problem.gradient = [](Vector x) {
    for (double& each : x) each -= 0.9;
    return x;
  };
  problem.hessian = [](const Vector&, double sigma, const Vector&) {
    Vector lower;
    for (std::size_t i = 0; i < kMany; ++i)
      for (std::size_t j = 0; j <= i; ++j) lower.push_back(i == j ? sigma : 0);
    return lower;
  };
  problem.start = Vector(kMany, 0.0);
  problem.bounds = {Vector(kMany, -1e3), Vector(kMany, 1e3), {}, {}};
  problem.finish();
  Options options;
  options.max_iterations = 5;
  const Answer answer =
      make_solver("interior_point")->solve(problem, problem.cold_start(), options);
  // The start has 40.5, and of all iterates the most room to far bounds.
  EXPECT_LT(answer.objective, 1) << to_string(answer.status);
}

TEST(Solver, AStartThatCannotBeEvaluatedComesBackAsItWas) {
  auto problem = hs071();
  const auto solver = make_solver();
  Answer answer = solver->solve(problem, problem.cold_start(), {});
  ASSERT_EQ(answer.status, Status::solved);
  problem.fault = [](const Vector&) { return Fault{"the objective", "", ""}; };
  Options options;
  for (const bool warm : {false, true}) {
    Start start{problem.start, {}, {}, {}};
    if (warm) start = {problem.start, {1, 2}, {3, 4, 5, 6}, {7, 8, 9, 10}};
    options.warm_start = warm;
    solver->solve(problem, start, options, answer);
    EXPECT_EQ(answer.status, Status::invalid_number);
    EXPECT_EQ(answer.point.x, start.x);
    EXPECT_EQ(answer.point.y, warm ? start.y : Vector(2, 0.0)) << "not those of the solve before";
    EXPECT_EQ(answer.point.zl, warm ? start.zl : Vector(4, 0.0));
    EXPECT_EQ(answer.point.zu, warm ? start.zu : Vector(4, 0.0));
  }
}

}  // namespace
}  // namespace slalom::nlp
