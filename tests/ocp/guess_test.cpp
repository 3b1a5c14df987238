// Guesses put together by name, and what is no guess.

#include "slalom/ocp/guess.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"
#include "slalom/ocp/interpolant.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A cart with one of everything.
struct Cart {
  Problem problem{"cart"};
  Expr x = problem.state("x", {-4, 10}), v = problem.state("v"), u = problem.control("u", {0, 3});
  Expr mass = problem.static_parameter("mass", {1, 9}, 2);
  Expr gap = problem.slack("gap", End::final, {0, 1}, 0.25);
  Expr work = problem.integral("work", square(u));
  Cart() {
    problem.dynamics(x, v);
    problem.dynamics(v, u / mass);
    problem.initial_bounds(x, Bounds::equal(-1));
    problem.final_time({1, 9}, 4);
  }
};

double at(const Trajectory& guess, double tau, std::size_t state) {
  for (std::size_t k = 0; k < guess.tau.size(); ++k)
    if (guess.tau[k] == tau) return guess.states[k][state];
  return kNaN;
}

TEST(Guesses, BeginAsLinesBetweenTheBounds) {
  Cart cart;
  const Trajectory guess = Guess(cart.problem, 5);
  EXPECT_EQ(guess.tau, (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(at(guess, 0, 0), -1);
  EXPECT_EQ(at(guess, 0.5, 0), 1);  // half way to the middle of the bounds, 3
  EXPECT_EQ(guess.controls[2][0], 1.5);
  EXPECT_EQ(guess.tf, 4);
  EXPECT_EQ(guess.static_parameters, (std::vector<double>{2}));
  EXPECT_EQ(guess.slacks, (std::vector<double>{0.25}));
}

TEST(Guesses, TakeConstantsLinesAndFunctions) {
  Cart cart;
  const Trajectory guess = Guess(cart.problem, 3)
                               .line("x", 2, 4)
                               .function("v", [](double t) { return t * t; })
                               .constant("u", 0.5)
                               .constant("mass", 3)
                               .constant("gap", 0.75)
                               .constant("work", 7)
                               .times(1, 3);
  EXPECT_EQ(guess.states[1], (std::vector<double>{3, 4}));  // at t = 2, set after the function
  EXPECT_EQ(guess.controls[1], (std::vector<double>{0.5}));
  EXPECT_EQ(guess.static_parameters[0], 3);
  EXPECT_EQ(guess.slacks[0], 0.75);
  EXPECT_EQ(guess.integrals[0], 7);
  EXPECT_EQ(guess.t0, 1);
  EXPECT_EQ(guess.tf, 3);
}

TEST(Guesses, FromASimulationObeyTheDynamics) {
  Cart cart;
  const Trajectory guess =
      Guess(cart.problem, 11).times(0, 2).simulated({-1, 0}, constant_controls({2}));
  EXPECT_NEAR(at(guess, 1, 0), -1 + 0.5 * 1 * 4, 1e-8);  // u / mass = 1
  EXPECT_NEAR(at(guess, 1, 1), 2, 1e-8);
  EXPECT_EQ(guess.controls[3][0], 2);
  EXPECT_EQ(guess.static_parameters[0], 2);
  Problem up("up");
  const Expr x = up.state("x");
  up.dynamics(x, square(x));
  EXPECT_NE(refusal([&] {
              Guess(up).times(0, 2).simulated({1}, constant_controls({}));
            }).find("up: guess: found up cannot be integrated past t = 1"),
            std::string::npos);
}

/// The regulator under other names, with one state more.
Problem renamed_regulator() {
  Problem p("renamed");
  const Expr extra = p.state("extra", {1, 3}), y = p.state("y"), w = p.control("w");
  p.dynamics(extra, y);
  p.dynamics(y, w);
  p.lagrange("cost", (square(y) + square(w)) / 2);
  p.initial_bounds(y, Bounds::equal(1));
  return p;
}

TEST(Guesses, FromAnEarlierSolutionOnAnotherMeshUnderOtherNames) {
  const auto form = regulator();
  const Solution earlier = solve(form.problem, {.mesh = Mesh({0, 0.1, 0.4, 1}), .scheme = lgr(6)});
  ASSERT_TRUE(earlier.solved());
  const Problem problem = renamed_regulator();
  const Trajectory guess =
      Guess(problem).from(form.problem, earlier, {.names = {{"y", "x"}, {"w", "u"}}});
  for (std::size_t k = 0; k < guess.tau.size(); ++k) {
    EXPECT_NEAR(guess.states[k][1], form.states(guess.tau[k])[0], 1e-7);
    EXPECT_EQ(guess.states[k][0], 2);  // which the earlier one has not
  }
  EXPECT_NEAR(guess.controls.front()[0], -std::tanh(1), 1e-5);
  for (std::size_t k = 0; k < earlier.trajectory.tau.size(); ++k)  // its points are points
    EXPECT_NEAR(at(guess, earlier.trajectory.tau[k], 1), earlier.trajectory.states[k][0], 1e-9);
  // So good a start saves iterations.
  const Solution cold = solve(problem), warm = solve(problem, {.guess = guess});
  ASSERT_TRUE(warm.solved());
  EXPECT_LE(warm.iterations, cold.iterations);
}

TEST(Guesses, FromAnEarlierTrajectoryByTauOrByTime) {
  Cart cart;
  const Trajectory earlier{0, 2, {0, 1}, {{0, 1}, {10, 1}}, {{1}, {2}}, {5}, {}};
  Guess guess(cart.problem, 3);
  const Trajectory stretched = Guess(guess).from(cart.problem, earlier).times(0, 8);
  EXPECT_EQ(stretched.states[1][0], 5);
  EXPECT_EQ(stretched.static_parameters[0], 5);
  const Trajectory shifted =
      Guess(guess).times(1, 3).from(cart.problem, earlier, {.by_time = true});
  EXPECT_EQ(shifted.t0, 1);
  EXPECT_EQ(shifted.states[0][0], 5);   // at t = 1
  EXPECT_EQ(shifted.states[1][0], 10);  // at t = 2
  EXPECT_EQ(shifted.states[2][0], 10);  // beyond its end
}

TEST(Guesses, AreTakenByTheSolve) {
  const auto form = brachistochrone();
  const Solution solution =
      solve(form.problem, {.guess = Guess(form.problem).line("v", 0, 5).line("theta", 0.1, 1)});
  EXPECT_TRUE(solution.solved());
  EXPECT_NEAR(solution.objective, form.objective, 1e-6);
}

TEST(GuessErrors, UnknownNamesComeWithTheNearest) {
  Cart cart;
  EXPECT_EQ(refusal([&] { Guess(cart.problem).constant("mas", 1); }),
            "cart: guess: found no variable 'mas', expected perhaps 'mass'");
  EXPECT_EQ(refusal([&] { Guess(cart.problem).line("mass", 1, 2); }),
            "cart: guess: found no state or control 'mass', expected a state or control of this "
            "problem");
  const Trajectory earlier{0, 2, {0, 1}, {{0, 1}, {10, 1}}, {{1}, {2}}, {5}, {}};
  const auto carried = [&](const char* ours, const char* theirs) {
    return refusal([&] {
      Guess(cart.problem).from(cart.problem, earlier, {.names = {{ours, theirs}}});
    });
  };
  EXPECT_EQ(carried("x", "worc"), "cart: guess: found no variable 'worc', expected perhaps 'work'");
  EXPECT_EQ(carried("q", "x"),
            "cart: guess: found no variable 'q', expected a variable of this problem");
  EXPECT_EQ(refusal([&] { Guess(cart.problem, 1); }), "cart: guess: found 1 points, expected >= 2");
}

TEST(GuessErrors, NumbersThatAreNone) {
  Cart cart;
  const auto refused = [](const Guess& guess) {
    return refusal([&] { (void)guess.trajectory(); });
  };
  Guess guess(cart.problem, 3);
  const std::string rule = ", expected a finite number";
  EXPECT_EQ(refused(Guess(guess).constant("v", kNaN)),
            "cart: guess: found v at point 0 = nan" + rule);
  EXPECT_EQ(refused(Guess(guess).function("u", [](double t) { return std::sqrt(2 - t); })),
            "cart: guess: found u at point 2 = " +
                std::string(std::signbit(std::sqrt(-2.0)) ? "-nan" : "nan") + rule);
  EXPECT_EQ(refused(Guess(guess).constant("mass", kNaN)), "cart: guess: found mass = nan" + rule);
  EXPECT_EQ(refused(Guess(guess).times(0, kInfinity)), "cart: guess: found tf = inf" + rule);
  EXPECT_EQ(refused(Guess(guess).times(3, 2)),
            "cart: guess: found tf = 2 before t0 = 3, expected tf >= t0");
}

TEST(GuessErrors, ShapesThatDoNotMatch) {
  Cart cart;
  const Trajectory good = Guess(cart.problem, 2);
  const auto refused = [&](auto change) {
    Trajectory bad = good;
    change(bad);
    return refusal([&] { check_guess(bad, cart.problem); });
  };
  EXPECT_EQ(refused([](Trajectory&) {}), "accepted");
  EXPECT_EQ(refused([](Trajectory& g) {
              g.tau = {1, 0};
            }),
            "cart: guess: found tau = 0 at point 1, expected taus that increase");
  EXPECT_EQ(refused([](Trajectory& g) { g.tau[0] = kNaN; }),
            "cart: guess: found tau = nan at point 0, expected taus that increase");
  EXPECT_EQ(refused([](Trajectory& g) {
              g.slacks = {1, 2};
            }),
            "cart: guess: found 2 slacks, expected at most 1");
  EXPECT_EQ(refused([](Trajectory& g) {
              g.static_parameters = {1, 2};
            }),
            "cart: guess: found 2 static parameters, expected at most 1");
  EXPECT_EQ(refused([](Trajectory& g) {
              g.integrals = {1, 2};
            }),
            "cart: guess: found 2 integrals, expected at most 1");
  EXPECT_EQ(refused([](Trajectory& g) { g.states[1][1] = kNaN; }),
            "cart: guess: found v at point 1 = nan, expected a finite number");
}

}  // namespace
}  // namespace slalom::ocp
