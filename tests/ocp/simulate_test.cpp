// Simulations against closed forms, corners of controls, and what cannot be simulated.

#include "slalom/ocp/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"
#include "slalom/ocp/errors.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

/// x'' = u - d x' with a run-time parameter d.
struct Cart {
  Problem problem{"cart"};
  Expr x = problem.state("x"), v = problem.state("v"), u = problem.control("u");
  Expr d = problem.parameter("d", 0.5);
  Cart() {
    problem.dynamics(x, v);
    problem.dynamics(v, u - d * v);
    problem.final_time(Bounds::equal(2), 2);
  }
};

TEST(Simulations, FollowAClosedForm) {
  Cart cart;
  const auto run = simulate(cart.problem, {0, 1}, constant_controls({0}), {.tolerance = 1e-12});
  ASSERT_TRUE(run.complete) << run.message;
  const Trajectory& course = run.trajectory;
  EXPECT_EQ(course.tf, 2);  // the problem's own
  ASSERT_EQ(course.tau.size(), 101u);
  for (std::size_t k = 0; k < course.tau.size(); ++k) {
    const double t = course.time(k);
    EXPECT_NEAR(course.states[k][1], std::exp(-0.5 * t), 1e-11);
    EXPECT_NEAR(course.states[k][0], 2 * (1 - std::exp(-0.5 * t)), 1e-11);
  }
}

TEST(Simulations, TakeTheParametersAsTheyAre) {
  Cart cart;
  cart.problem.set_parameter(cart.d, 0);
  const auto run = simulate(cart.problem, {0, 1}, constant_controls({2}), {.tf = 3});
  EXPECT_NEAR(run.trajectory.states.back()[0], 3 + 9, 1e-8);
  EXPECT_NEAR(run.trajectory.states.back()[1], 1 + 6, 1e-8);
}

TEST(Simulations, HaveAPointAtEachCornerAndJumpThere) {
  Cart cart;
  cart.problem.set_parameter(cart.d, 0);
  const double jump = 0.7;
  int late = 0;
  const auto law = [&](double t) {
    late += t == jump ? 1 : 0;
    return std::vector<double>{t < jump ? 1.0 : -1.0};
  };
  const auto run = simulate(cart.problem, {0, 0}, controls_of_time(law, {jump}),
                            {.tf = 2, .steps = 4, .tolerance = 1e-12});
  ASSERT_TRUE(run.complete);
  const Trajectory& course = run.trajectory;
  ASSERT_EQ(course.tau.size(), 6u);
  EXPECT_DOUBLE_EQ(course.time(2), jump);
  EXPECT_NEAR(course.states[2][1], jump, 1e-12);  // exactly: no step lay across the jump
  EXPECT_NEAR(course.states.back()[1], jump - (2 - jump), 1e-12);
  EXPECT_EQ(course.controls[1][0], 1);
  EXPECT_EQ(course.controls[2][0], -1);
  EXPECT_EQ(late, 0);  // the law is asked within the stretches
}

TEST(Simulations, FollowAFeedback) {
  Cart cart;
  cart.problem.set_parameter(cart.d, 0);
  const Controls brake{
      [](double, std::span<const double> x) { return std::vector<double>{-x[0] - 2 * x[1]}; }};
  const auto run = simulate(cart.problem, {1, 0}, brake, {.tf = 4, .tolerance = 1e-11});
  EXPECT_NEAR(run.trajectory.states.back()[0], (1 + 4) * std::exp(-4), 1e-9);
}

TEST(Simulations, OfASolutionsControlsComeToItsEnd) {
  const auto form = least_energy();
  for (const auto& scheme : {hermite_simpson(), lgr(4), backward_euler()}) {
    const Solution solution =
        solve(form.problem, {.mesh = Mesh({0, 0.3, 0.5, 1}), .scheme = scheme});
    ASSERT_TRUE(solution.solved());
    const auto run =
        simulate(form.problem, {0, 0}, controls_of(form.problem, solution), {.tolerance = 1e-11});
    ASSERT_TRUE(run.complete);
    const double gap = std::fabs(run.trajectory.states.back()[0] - 1);
    EXPECT_NEAR(gap, scheme.order == 1 ? estimate_errors(form.problem, solution).horizon * 2 : 0,
                scheme.order == 1 ? 0.2 : 1e-8)
        << scheme.name;
  }
}

TEST(Simulations, OfAnotherModel) {
  const System pendulum{
      "pendulum",
      {"angle", "rate"},
      {},
      [](double, std::span<const double> x, std::span<const double>, std::span<double> rates) {
        rates[0] = x[1];
        rates[1] = -std::sin(x[0]);
      }};
  const auto run =
      simulate(pendulum, {3, 0}, constant_controls({}), {.tf = 20, .tolerance = 1e-11});
  ASSERT_TRUE(run.complete);
  for (const auto& x : run.trajectory.states)
    EXPECT_NEAR(x[1] * x[1] / 2 - std::cos(x[0]), -std::cos(3.0), 1e-9);
}

TEST(Simulations, AreAccurateInUnitsOfTheScales) {
  const double size = 1e-9;
  const System oscillator{
      "oscillator",
      {"x", "v"},
      {},
      [](double, std::span<const double> x, std::span<const double>, std::span<double> rates) {
        rates[0] = x[1];
        rates[1] = -x[0];
      },
      {size, size}};
  const auto run = simulate(oscillator, {size, 0}, constant_controls({}),
                            {.tf = 20, .steps = 1, .tolerance = 1e-8});
  EXPECT_NEAR(run.trajectory.states.back()[0] / size, std::cos(20.0), 1e-5);
}

TEST(Simulations, ThatBlowUpSayWhere) {
  Problem p("blow-up");
  const Expr x = p.state("x");
  p.dynamics(x, square(x));
  const auto run = simulate(p, {1}, constant_controls({}), {.tf = 2, .steps = 10});
  EXPECT_FALSE(run.complete);
  EXPECT_NEAR(run.trajectory.tf, 1, 1e-6);  // x = 1 / (1 - t)
  EXPECT_EQ(run.trajectory.tau.size(), run.trajectory.states.size());
  EXPECT_EQ(run.message.find("blow-up cannot be integrated past t = 1"), 0u) << run.message;
}

TEST(Simulations, EndWhereTheyAreTold) {
  Cart cart;
  int asked = 0;
  SimulateSettings settings{.tf = 1e6, .steps = 1000, .stop = [&asked] { return ++asked > 100; }};
  const auto run = simulate(cart.problem, {0, 1}, constant_controls({0}), settings);
  EXPECT_FALSE(run.complete);
  EXPECT_NE(run.message.find("cart was stopped after t = "), std::string::npos) << run.message;
  EXPECT_EQ(asked, 101);
  EXPECT_LT(run.trajectory.tf, 1e6);
  EXPECT_EQ(run.trajectory.tau.size(), run.trajectory.states.size());
  asked = 100;
  const auto none = simulate(cart.problem, {0, 1}, constant_controls({0}), settings);
  EXPECT_EQ(none.trajectory.states, (std::vector<std::vector<double>>{{0, 1}}));
}

TEST(Simulations, OfNoTimeHaveOnePoint) {
  Cart cart;
  const auto run = simulate(cart.problem, {3, 4}, constant_controls({5}), {.t0 = 1, .tf = 1});
  ASSERT_TRUE(run.complete);
  ASSERT_EQ(run.trajectory.states.size(), 1u);
  EXPECT_EQ(run.trajectory.states[0][1], 4);
  EXPECT_EQ(run.trajectory.controls[0][0], 5);
}

TEST(SimulationErrors, NameWhatDoesNotMatch) {
  Cart cart;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto run = [&](const std::vector<double>& x0, const std::vector<double>& u,
                       const SimulateSettings& settings = {}) {
    return refusal([&] { (void)simulate(cart.problem, x0, constant_controls(u), settings); });
  };
  EXPECT_EQ(run({0}, {0}), "cart: simulation: found 1 initial states, expected 2");
  EXPECT_EQ(run({0, nan}, {0}),
            "cart: simulation: found initial v = nan, expected a finite number");
  EXPECT_EQ(run({0, 0}, {0, 1}), "cart: simulation: found 2 controls at t = 0, expected 1");
  EXPECT_EQ(run({0, 0}, {0}, {.t0 = 3, .tf = 2}),
            "cart: simulation: found t0 = 3, tf = 2, expected finite t0 <= tf");
  EXPECT_EQ(run({0, 0}, {0}, {.steps = 0}), "cart: simulation: found 0 steps, expected at least 1");
  EXPECT_EQ(run({0, 0}, {0}, {.tolerance = 0}),
            "cart: simulation: found tolerance 0, expected a number > 0 and < 1");
  EXPECT_EQ(refusal([&] {
              (void)simulate(cart.problem, {0, 0}, Controls{});
            }),
            "cart: simulation: found no controls, expected a function");
  Problem late("late");
  const Expr x = late.state("x");
  EXPECT_EQ(refusal([&] { (void)system_of(late); }),
            "late: simulation: found no dynamics of x, expected a call of dynamics for each state");
  late.dynamics(x, late.final(x));
  EXPECT_EQ(refusal([&] { (void)system_of(late); }),
            "late: simulation: found dynamics that use final(x), expected dynamics that a "
            "simulation can know");
}

}  // namespace
}  // namespace slalom::ocp
