// The time limit and the callback that stops a solve hold during its set-up, however large.

#include <gtest/gtest.h>

#include <string>

#include "slalom/base/timer.hpp"
#include "slalom/ocp/many.hpp"
#include "slalom/ocp/prepared.hpp"
#include "slalom/ocp/solve.hpp"
#include "support/sanitized.hpp"

namespace slalom::ocp {
namespace {

/// Its transcription takes a minute.
Problem large(const std::string& name) {
  Problem p(name);
  std::vector<Expr> x, u;
  for (int i = 0; i < 8; ++i) x.push_back(p.state("x" + std::to_string(i)));
  for (int i = 0; i < 3; ++i) u.push_back(p.control("u" + std::to_string(i), {-1, 1}));
  for (int i = 0; i < 8; ++i) {
    p.dynamics(x[i], sin(x[(i + 1) % 8]) * u[i % 3] - square(x[i]) * exp(-x[(i + 2) % 8]));
    p.initial_bounds(x[i], Bounds::equal(0.1 * i));
  }
  p.path("product", x[0] * x[1], Bounds::at_most(5));
  p.lagrange("effort", square(u[0]) + square(u[1]) + square(u[2]));
  return p;
}
constexpr int kIntervals = kSanitized ? 25000 : 100000, kPoints = 4;
constexpr std::size_t kSize = std::size_t{kIntervals} * kPoints + 1;
const PhasedTranscription::Grid kGrid{Mesh::uniform(kIntervals), lgr(kPoints)};
constexpr double kLimit = 0.3, kLate = 12;  ///< [s], the latter for a machine with much else to do

template <class Answer>
void expect_ended(const Answer& answer, nlp::Status status, const Timer& timer) {
  EXPECT_EQ(answer.status, status);
  EXPECT_FALSE(answer.solved());
  EXPECT_EQ(answer.iterations, 0);
  EXPECT_LT(timer.wall(), kLate);
}

TEST(SetUp, IsHeldToTheTimeLimit) {
  const Timer timer;
  SolveSettings settings{.mesh = kGrid.mesh, .scheme = kGrid.schemes};
  settings.options.time_limit = kLimit;
  const Solution solution = solve(large("large"), settings);
  expect_ended(solution, nlp::Status::time_limit, timer);
  ASSERT_EQ(solution.trajectory.tau.size(), kSize) << "the guess at the points";
  EXPECT_EQ(solution.state("x3").size(), kSize);
  EXPECT_DOUBLE_EQ(solution.state("x3").front(), 0.3);
}

TEST(SetUp, OfPhasesIsHeldToIt) {
  const Timer timer;
  PhasedProblem both("both");
  both.add(large("first"));
  both.add(large("second"));
  both.connect(0, 1, {.without = {"time"}});
  PhasedSettings settings;
  settings.grids.assign(2, kGrid);
  settings.options.time_limit = kLimit;
  const PhasedSolution solution = solve(both, settings);
  expect_ended(solution, nlp::Status::time_limit, timer);
  ASSERT_EQ(solution.phases.size(), 2u);
  EXPECT_EQ(solution.phases[1].trajectory.tau.size(), kSize);
}

/// Ends what has its options after kLimit.
struct Clock {
  Timer timer;
  void put(nlp::Options& options) {
    options.stop = [](void* data) { return static_cast<Clock*>(data)->timer.wall() > kLimit; };
    options.stop_data = this;
  }
};

TEST(SetUp, IsEndedByTheCallback) {
  SolveSettings settings{.mesh = kGrid.mesh, .scheme = kGrid.schemes};
  Clock clock;
  clock.put(settings.options);
  expect_ended(solve(large("large"), settings), nlp::Status::interrupted, clock.timer);
}

TEST(SetUp, OfAPreparedProblemIsEndedByTheCallback) {
  SolveSettings settings{.mesh = kGrid.mesh, .scheme = kGrid.schemes};
  Clock clock;
  clock.put(settings.options);
  Prepared prepared(large("large"), settings);
  const Solution solution = prepared.solve();
  expect_ended(solution, nlp::Status::interrupted, clock.timer);
  EXPECT_EQ(solution.trajectory.tau.size(), kSize) << "the guess at the points";
}

TEST(SetUp, OfManySolvesIsEndedByTheCallback) {
  SolveSettings settings{.mesh = kGrid.mesh, .scheme = kGrid.schemes};
  Clock clock;
  clock.put(settings.options);
  const auto answers = solve_many(large("large"), settings, {{"initial x0", {0, 0.1}}}, 2);
  ASSERT_EQ(answers.size(), 2u);
  for (const Solution& answer : answers)
    expect_ended(answer, nlp::Status::interrupted, clock.timer);
}

}  // namespace
}  // namespace slalom::ocp
