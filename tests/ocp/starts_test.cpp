// Solves from several starts, and a second try where the first ended beside what can be met.

#include "slalom/ocp/starts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "ocp/messages.hpp"
#include "ocp/pushed_mass.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/kinks.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

/// Least time of x'' = u, |u| <= 1, to rest at 0 from a point in motion.
Problem to_rest(double x0, double v0) {
  Problem p("to rest");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u", {-1, 1});
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.fix(x, x0, 0);
  p.fix(v, v0, 0);
  p.final_time({0.01, 100}, 1);
  p.mayer("duration", p.final_time());
  return p;
}

TEST(Starts, ASecondTryFollowsAPointOfLeastViolation) {
  for (const auto& [x0, v0] : {std::pair{1.0, 1.0}, {2.0, 3.0}, {1.0, 2.0}, {-3.0, 4.0}}) {
    SCOPED_TRACE(x0);
    // Braking first where it passes 0 on the way, u = -1 at first otherwise.
    const bool right = x0 > -v0 * std::fabs(v0) / 2;
    const double time =
        right ? v0 + 2 * std::sqrt(x0 + v0 * v0 / 2) : -v0 + 2 * std::sqrt(-x0 + v0 * v0 / 2);
    const Solution solution = solve(to_rest(x0, v0));
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.objective, time, 5e-3);
  }
}

TEST(Starts, WithinTheIterationsThatAreAllowed) {
  Problem never = to_rest(1, 1);
  never.final_time({0.01, 2}, 1);  // takes 3.4
  const Solution solution = solve(never);
  EXPECT_EQ(solution.status, nlp::Status::infeasible);
  EXPECT_FALSE(solution.conflicts.empty());
  const int few = 60;  // not enough for coarse meshes to be tried
  const Solution cut = solve(never, {.options = {.max_iterations = few}});
  EXPECT_LE(cut.iterations, few);
  EXPECT_EQ(cut.options.max_iterations, few) << "as they were asked for";
}

/// Two ways round a disc, of which the guess leads along the longer.
Problem two_ways() {
  Problem p("two ways");
  const Expr x = p.state("x"), y = p.state("y"), u = p.control("u"), v = p.control("v");
  p.dynamics(x, u);
  p.dynamics(y, v);
  p.fix(x, -2, 2);
  p.fix(y, 0, 0);
  p.path("disc", square(x) + square(y - 0.3), Bounds::at_least(1));
  p.lagrange("effort", square(u) + square(v));
  return p;
}

TEST(Starts, OfSeveralTheBestIsFound) {
  const Problem p = two_ways();
  SolveSettings above;
  above.guess =
      Guess(p).function("y", [](double t) { return 3 * std::sin(M_PI * t); }).trajectory();
  const double worse = solve(p, above).objective;
  const auto answers = solve_from_several(p, above, 8, 5);
  ASSERT_EQ(answers.size(), 8U);
  EXPECT_EQ(answers.front().objective, worse) << "the first start is the settings' own";
  const Solution& best = answers[best_of(answers)];
  EXPECT_TRUE(best.solved());
  EXPECT_LT(best.objective, worse - 0.5) << "below the disc";
  const auto again = solve_from_several(p, above, 8, 5);
  for (std::size_t k = 0; k < answers.size(); ++k)
    EXPECT_EQ(answers[k].objective, again[k].objective) << k;
  EXPECT_EQ(refusal([&] { (void)solve_from_several(p, above, 0); }),
            "two ways: starts: found 0, expected at least 1");
}

TEST(Starts, MovedGuessesKeepTheBounds) {
  const Problem p = to_rest(1, 1);
  const Trajectory guess = straight_guess(p);
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const Trajectory moved = moved_guess(p, guess, seed);
    EXPECT_GE(moved.tf, 3);
    EXPECT_LE(moved.tf, 40);
    EXPECT_EQ(moved.t0, 0);
    for (const auto& u : moved.controls) EXPECT_LT(std::fabs(u[0]), 1);
  }
}

// --- kinks -----------------------------------------------------------------------------------

TEST(SmoothKinks, SayTheSameByRows) {
  const auto least_fuel = [](const std::function<Expr(const Expr&)>& cost) {
    PushedMass mass("least fuel");
    mass.problem.final_time(Bounds::equal(4), 4);
    mass.problem.lagrange("fuel", cost(mass.u));
    return mass.problem;
  };
  const double right = 4 - std::sqrt(12.0);  // full force for s at both ends: s (4 - s) = 1
  for (const auto& cost : std::vector<std::function<Expr(const Expr&)>>{
           [](const Expr& u) { return abs(u); }, [](const Expr& u) { return max(u, -u); },
           [](const Expr& u) { return 1 - 2 * min(u / 2, -u / 2) - 1; },
           [](const Expr& u) { return max(abs(u), 0.0) / 2 + abs(u) * 0.5; }}) {
    Problem p = least_fuel(cost);
    const Solution kinked = solve(p, {.options = {.max_iterations = 100}});
    EXPECT_FALSE(kinked.solved());
    EXPECT_EQ(kinked.kinks, std::vector<std::string>{"fuel"}) << "named as a cause";
    const auto done = smooth_kinks(p);
    ASSERT_FALSE(done.empty());
    EXPECT_EQ(done.front().find("cost fuel: "), 0U) << done.front();
    const Solution solution = solve(p, {.mesh = Mesh::uniform(80)});
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.objective, right, 1e-3);
    EXPECT_TRUE(solution.kinks.empty());
    EXPECT_TRUE(smooth_kinks(p).empty()) << "done already";
  }
  // Not those that are to be large: no rows would hold them.
  Problem concave = least_fuel([](const Expr& u) { return square(u) - abs(u); });
  EXPECT_TRUE(smooth_kinks(concave).empty());
}

}  // namespace
}  // namespace slalom::ocp
