// Back end nl: what its files say, read by AMPL's own library, and what it makes of a solver's
// ends.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "../../src/nlp/nl/nl_file.hpp"
#include "../../src/nlp/nl/sol_file.hpp"
#include "expr/op_cases.hpp"
#include "nl_solver/nl_solver.hpp"
#include "nlp/hock_schittkowski/problems.hpp"
#include "slalom/base/error.hpp"
#include "slalom/nlp/check.hpp"

namespace slalom::nlp {
namespace {

Answer solve(Problem& problem, const Start& start, Options options, const std::string& program) {
  options.nl_solver = program;
  return make_solver("nl")->solve(problem, start, options);
}

/// min (a - 1)^2 + c, rows: linear a + 2 c = 3 (+ a constant); a b >= 1; a range on b.
ExpressionProblem mixed() {
  Statement s;
  const auto x = s.variables({0.5, 2, 0});
  s.minimise(square(x[1] - 1) + x[3]);
  s.between(3, x[1] + 2 * x[3] + 4, 3, "linear");
  s.nonnegative(x[1] * x[2] - 1, "product");
  s.between(-2, x[2], 2, "range");
  return ExpressionProblem(s);
}

TEST(NlFile, SaysWhatIsLinearAndPutsTheRestFirst) {
  const auto problem = mixed();
  const auto file = nl_file(*problem.formulas(), problem.limits(), problem.cold_start(), false);
  // Rows: the product first. Variables: a (in both), b (in rows), c.
  EXPECT_EQ(file.rows, (std::vector<std::uint32_t>{1, 0, 2}));
  EXPECT_EQ(file.variables, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(file.text.substr(0, file.text.find("C0")),
            "g3 1 1 0\n 3 3 1 1 1\n 1 1\n 0 0\n 2 1 1\n 0 0 0 1\n 0 0 0 0 0\n 5 2\n 0 0\n"
            " 0 0 0 0 0\n");
  EXPECT_NE(file.text.find("r\n2 0\n4 -1\n0 -2 2\n"), std::string::npos) << file.text;
  EXPECT_NE(file.text.find("k2\n2\n4\nJ0 2\n0 0\n1 0\nJ1 2\n0 1\n2 2\nJ2 1\n1 1\nG0 2\n"),
            std::string::npos)
      << file.text;
}

TEST(NlFile, DefinesWhatIsSharedOnce) {
  Statement s;
  const auto x = s.variables({1, 1});
  const auto everywhere = sin(x[1]), rows = cos(x[2]), one = exp(x[2]);
  s.minimise(everywhere * x[2]);
  s.zero(everywhere * rows);
  s.zero(rows * x[1] + one * sqrt(one));
  const ExpressionProblem problem(s);
  const auto text =
      nl_file(*problem.formulas(), problem.limits(), problem.cold_start(), false).text;
  EXPECT_NE(text.find("\n 1 1 0 1 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("V2 0 0\no41\nv0\nV3 0 0\no46\nv1\nC0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("V4 0 2\no44\nv1\nC1\n"), std::string::npos) << text;
}

/// Every operation at fixed arguments: the rows z = op(a, b, c) leave the solver no choice.
TEST(Nl, EveryOperationMeansTheSameToAmplsLibrary) {
  SLALOM_NEEDS_NL_SOLVER();
  std::mt19937_64 random(7);
  Statement s;
  Vector lower, upper, expected;
  for (const auto& op : expr::op_cases()) {
    const auto at = op.point(random);
    const auto a = s.variables(at);
    const auto z = s.variables({0.0});
    s.zero(op.build(a.list()) - z[1], op.name);
    expr::Function f(a.list(), {}, {op.build(a.list())});
    Vector value(1);
    f(at, {}, value);
    for (const double number : at) {
      lower.push_back(number);
      upper.push_back(number);
      expected.push_back(number);
    }
    lower.push_back(-kInf);
    upper.push_back(kInf);
    expected.push_back(value[0]);
  }
  s.lower(lower);
  s.upper(upper);
  ExpressionProblem problem(s);
  const auto answer = solve(problem, problem.cold_start(), {}, nl_solver());
  ASSERT_EQ(answer.status, Status::solved) << answer.message;
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(answer.point.x[i], expected[i], 1e-9 * (1 + std::fabs(expected[i]))) << i;
}

TEST(Nl, SolvesHockAndSchittkowskisProblemsAsInteriorPointDoes) {
  SLALOM_NEEDS_NL_SOLVER();
  int solved = 0;
  for (const auto& statement : hock_schittkowski()) {
    if (statement.number % 6 != 1 || statement.number == 13) continue;  // 13: no multipliers
    SCOPED_TRACE(statement.number);
    ExpressionProblem problem(statement);
    const Options options;
    const auto ours = make_solver()->solve(problem, problem.cold_start(), options);
    const auto answer = solve(problem, problem.cold_start(), options, nl_solver());
    if (ours.status != Status::solved || answer.status != Status::solved) continue;
    if (std::fabs(ours.objective - answer.objective) > 1e-3 * (1 + std::fabs(ours.objective)))
      continue;  // another local optimum
    EXPECT_NEAR(answer.objective, ours.objective, 1e-6 * (1 + std::fabs(ours.objective)));
    EXPECT_TRUE(check(problem, answer.point, options).solved(options));
    ++solved;
  }
  EXPECT_GE(solved, 12);
}

TEST(Nl, AWarmStartTakesItsMultipliersAlong) {
  SLALOM_NEEDS_NL_SOLVER();
  auto problem = mixed();
  Options options;
  const auto cold = solve(problem, problem.cold_start(), options, nl_solver());
  ASSERT_EQ(cold.status, Status::solved) << cold.message;
  options.warm_start = true;
  options.max_iterations = 8;
  const auto warm = solve(problem, cold.point, options, nl_solver());
  EXPECT_EQ(warm.status, Status::solved) << warm.message;
  for (std::size_t r = 0; r < 3; ++r) EXPECT_NEAR(warm.point.y[r], cold.point.y[r], 1e-6);
}

// --- solvers that end badly --------------------------------------------------------------------

/// A shell script as a solver.
class FakeSolver : public testing::Test {
 protected:
  FakeSolver() {
    folder_ = std::filesystem::temp_directory_path() /
              ("slalom-fake-" + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder_);
  }
  ~FakeSolver() override { std::filesystem::remove_all(folder_); }

  Answer run(const std::string& script, const Options& options = {}) {
    const auto program = folder_ / "fake";
    std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    auto problem = mixed();
    return solve(problem, problem.cold_start(), options, program.string());
  }
  /// Prints a .sol file with this result number.
  static std::string ends(const std::string& result) {
    return "printf 'Told so\\n\\nOptions\\n3\\n1\\n1\\n0\\n3\\n3\\n3\\n3\\n1\\n2\\n3\\n4\\n5\\n6\\n"
           "objno 0 " +
           result + "\\n' > problem.sol";
  }

  std::filesystem::path folder_;
};

TEST_F(FakeSolver, AnswersGoBackToTheProblemsOrder) {
  const auto answer = run(ends("0"));
  EXPECT_EQ(answer.status, Status::solved);
  EXPECT_EQ(answer.message, "Told so");
  EXPECT_EQ(answer.backend, "nl, fake");
  EXPECT_EQ(answer.point.x, (Vector{4, 5, 6}));
  EXPECT_EQ(std::fabs(answer.point.y[0]), 2);  // rows 1, 0, 2 in the file
  EXPECT_EQ(std::fabs(answer.point.y[1]), 1);
  EXPECT_NEAR(answer.violation, 17, 1e-12);  // 4 + 2 * 6 + 4 - 3
}

TEST_F(FakeSolver, ResultNumbersAreStatuses) {
  const std::pair<const char*, Status> cases[] = {{"1", Status::solved},
                                                  {"100", Status::numerical_failure},
                                                  {"200", Status::infeasible},
                                                  {"300", Status::unbounded},
                                                  {"400", Status::iteration_limit},
                                                  {"401", Status::time_limit},
                                                  {"402", Status::iteration_limit},
                                                  {"500", Status::numerical_failure},
                                                  {"503", Status::invalid_number},
                                                  {"504", Status::too_few_freedoms}};
  for (const auto& [result, status] : cases) EXPECT_EQ(run(ends(result)).status, status) << result;
}

TEST_F(FakeSolver, NoOrDamagedAnswersAreFailuresWithAReason) {
  const auto expect = [&](const std::string& script, const std::string& reason) {
    const auto answer = run(script);
    EXPECT_EQ(answer.status, Status::numerical_failure) << script;
    EXPECT_NE(answer.message.find(reason), std::string::npos) << answer.message;
    EXPECT_EQ(answer.point.x, (Vector{0.5, 2, 0})) << script;
  };
  expect("echo no licence; exit 3", "code 3: no licence");
  expect("kill -9 $$", "code 137");
  expect(": > problem.sol", "problem.sol:1: found the end of the file, expected a line 'Options'");
  expect("printf 'hm\\n\\nOptions\\nx\\n' > problem.sol", "problem.sol:4: found 'x'");
  expect("printf 'hm\\n\\nOptions\\n0\\n2\\n2\\n3\\n3\\n' > problem.sol", "3 rows, as the .nl");
  expect("printf 'hm\\n\\nOptions\\n0\\n3\\n0\\n3\\n3\\n1\\n2\\n' > problem.sol",
         "the end of the file, expected a variable's value");
  expect("printf 'hm\\n\\nOptions\\n0\\n3\\n0\\n3\\n0\\nobjno 0 0\\n' > problem.sol", "no values");
}

TEST_F(FakeSolver, ANumberIsFiniteAndTheWholeOfItsLine) {
  const std::string head = "printf 'hm\\n\\nOptions\\n1\\n1\\n3\\n3\\n3\\n3\\n";
  const std::string numbers = "1\\n2\\n3\\n4\\n5\\n6\\n", last = "objno 0 0\\n";
  const std::string suffix = "suffix 4 1 13 0 0\\nipopt_zL_out\\n1 0.25\\n";
  const auto status = [&](const std::string& text) {
    return run(head + text + "' > problem.sol").status;
  };
  EXPECT_EQ(status(numbers + last + suffix), Status::solved);
  EXPECT_EQ(status(" +1e0 \\n2\\n3\\n4\\n5\\n6\\r\\n objno 0 0\\n" + last), Status::solved);
  for (const std::string bad : {"nan", "1e400junk", "1e400", "-inf", "Infinity", "1 2", "1,5",
                                "0x1p3", "1.5.", "", "--1", "1e"}) {
    EXPECT_EQ(status(bad + "\\n2\\n3\\n4\\n5\\n6\\n" + last), Status::numerical_failure) << bad;
    EXPECT_EQ(status("1\\n2\\n3\\n4\\n5\\n" + bad + "\\n" + last), Status::numerical_failure)
        << bad;
    EXPECT_EQ(status(numbers + last + "suffix 4 1 13 0 0\\nipopt_zL_out\\n1 " + bad + "\\n"),
              Status::numerical_failure)
        << bad;
  }
  for (const std::string bad : {"objno 0 0junk", "objno 0", "objno x 0", "objno 0 0 0",
                                "objno 0 0.5", "objno 0 99999999999"})
    EXPECT_EQ(status(numbers + bad + "\\n"), Status::numerical_failure) << bad;
  for (const std::string bad : {"-1", "1.5", "1x", "99999999999999999999"}) {
    EXPECT_EQ(run("printf 'hm\\n\\nOptions\\n" + bad + "\\n' > problem.sol").status,
              Status::numerical_failure);
    EXPECT_EQ(status(numbers + last + "suffix 4 " + bad + " 13 0 0\\nipopt_zL_out\\n1 0.25\\n"),
              Status::numerical_failure)
        << bad;
  }
}

TEST_F(FakeSolver, StopsAtTheDeadlineAndWhenAsked) {
  Options options;
  options.time_limit = 0.1;
  EXPECT_EQ(run("while :; do :; done", options).status, Status::time_limit);
  const auto asleep = run("exec sleep 100", options);
  EXPECT_EQ(asleep.status, Status::time_limit);
  EXPECT_LT(asleep.wall_s, 10);
  Options asked;
  asked.stop = [](void*) { return true; };
  const auto answer = run("sleep 100", asked);
  EXPECT_EQ(answer.status, Status::interrupted);
  EXPECT_LT(answer.wall_s, 10);
}

TEST_F(FakeSolver, IsToldTheOptionsInItsWords) {
  Options options;
  options.nl_options = "one=1 two";
  EXPECT_NE(run("echo $*; exit 1", options).message.find("problem.nl -AMPL one=1 two"),
            std::string::npos);
}

template <class F>
std::string refusal(F f) {
  try {
    f();
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "accepted";
}

TEST_F(FakeSolver, WhatCannotBeAskedIsRefusedBeforehand) {
  auto problem = mixed();
  EXPECT_NE(refusal([&] {
              (void)solve(problem, problem.cold_start(), {}, "no-such-solver");
            }).find("nl_solver: found 'no-such-solver', expected an executable"),
            std::string::npos);
  Options floor;
  floor.floor = 0.5;
  EXPECT_NE(refusal([&] { (void)run("exit 0", floor); }).find("floor: found 0.5 for fake"),
            std::string::npos);
  auto numbers = hs071();
  EXPECT_NE(refusal([&] {
              (void)solve(numbers, numbers.cold_start(), {}, "/bin/true");
            }).find("a problem that gives numbers alone"),
            std::string::npos);
}

TEST(SolFile, ReadsSuffixesOfVariablesAndSkipsOthers) {
  const auto sol = read_sol(
      "a\nb\n\nOptions\n2\n1\n0\n1\n1\n2\n2\n7\n8\n9\nobjno 0 3\n"
      "suffix 4 1 13 0 0\nipopt_zL_out\n1 0.25\n"
      "suffix 1 1 4 8 1\nother\na table\n0 5\n",
      2, 1, "here");
  EXPECT_EQ(sol.message, "a; b");
  EXPECT_EQ(sol.result, 3);
  EXPECT_EQ(sol.y, Vector{7});
  EXPECT_EQ(sol.x, (Vector{8, 9}));
  ASSERT_EQ(sol.variable_suffixes.size(), 1u);
  EXPECT_EQ(sol.variable_suffixes.at("ipopt_zL_out"), (Vector{0, 0.25}));
  EXPECT_NE(refusal([] {
              (void)read_sol("\nOptions\n0\n0\n0\n1\n0\nsuffix 4 1 2 0 0\nz\n9 1\n", 1, 0, "there");
            }).find("there:10: found '9 1', expected the index of a variable"),
            std::string::npos);
}

}  // namespace
}  // namespace slalom::nlp
