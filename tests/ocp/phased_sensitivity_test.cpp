// How answers in several phases move with the numbers of their problems.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ocp/messages.hpp"
#include "slalom/ocp/sensitivity.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

/// Numbers of two carts, the second of which takes over from the first, slower by a jump.
struct Numbers {
  double mass = 1.3, drag = 0.2, start = 0.1, hand_over = 1, most = 1.4, jump = -0.15;
};

Problem cart(const std::string& name, const Numbers& numbers) {
  Problem p(name);
  const Expr x = p.state("x"), v = p.state("v", Bounds::at_most(numbers.most));
  const Expr u = p.control("u", {-3, 3});
  const Expr drag = p.parameter("drag", numbers.drag);
  p.dynamics(x, v);
  p.dynamics(v, u - drag * v * sqrt(square(v) + 0.01));
  p.lagrange("effort", square(u));
  return p;
}

PhasedProblem carts(const Numbers& numbers) {
  Problem first = cart("first", numbers), second = cart("second", numbers);
  const Expr x1 = first.states()[0].symbol, v1 = first.states()[1].symbol;
  const Expr x2 = second.states()[0].symbol, v2 = second.states()[1].symbol;
  first.lagrange("by mass",
                 first.parameter("mass", numbers.mass) * square(first.controls()[0].symbol));
  first.initial_bounds(x1, Bounds::equal(numbers.start));
  first.initial_bounds(v1, Bounds::equal(0));
  first.final_bounds(x1, Bounds::equal(numbers.hand_over));
  first.final_time({0.2, 5}, 1);
  second.initial_time({0.2, 5}, 1);
  second.final_time({0.3, 8}, 2);
  second.final_bounds(x2, Bounds::equal(2.5));
  second.final_bounds(v2, Bounds::equal(0));
  second.mayer("arrival", 4 * second.final_time());
  PhasedProblem both("carts");
  both.add(first);
  both.add(second);
  both.connect(0, 1, {{"v"}, {}});
  both.link("jump", second.initial(v2) - first.final(v1), Bounds::equal(numbers.jump));
  both.mayer("late", 0.3 * square(first.final_time()));
  return both;
}

PhasedSettings settings(double floor) {
  PhasedSettings s;
  s.grids = {{Mesh::uniform(5), hermite_simpson_compressed()}, {Mesh::uniform(4), lgr(3)}};
  s.options.floor = floor;
  s.options.tol = s.options.constraint_tol = 1e-10;
  s.options.dual_tol = floor > 0 ? 1e-9 : 1e-5;
  s.options.floor_tol = 1e-9;
  return s;
}

PhasedSolution solved(const Numbers& numbers, const PhasedSettings& how) {
  PhasedSolution solution = solve(carts(numbers), how);
  EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
  return solution;
}

void compare(const std::vector<std::vector<double>>& rate,
             const std::vector<std::vector<double>>& low,
             const std::vector<std::vector<double>>& high, double over, double tolerance) {
  for (std::size_t k = 0; k < rate.size(); ++k)
    for (std::size_t i = 0; i < rate[k].size(); ++i)
      EXPECT_NEAR(rate[k][i], (high[k][i] - low[k][i]) / over,
                  tolerance * (1 + std::fabs(rate[k][i])))
          << k;
}

void compare(const PhasedSensitivity& s, const PhasedSolution& low, const PhasedSolution& high,
             double over, double tolerance) {
  EXPECT_NEAR(s.objective, (high.objective - low.objective) / over, tolerance);
  for (std::size_t l = 0; l < s.link_multipliers.size(); ++l)
    EXPECT_NEAR(s.link_multipliers[l].second,
                (high.link_multipliers[l].second - low.link_multipliers[l].second) / over,
                tolerance * (1 + std::fabs(s.link_multipliers[l].second)));
  for (std::size_t p = 0; p < s.phases.size(); ++p) {
    const auto &r = s.phases[p].trajectory, &a = low.phases[p].trajectory,
               &b = high.phases[p].trajectory;
    EXPECT_NEAR(s.phases[p].objective, (high.phases[p].objective - low.phases[p].objective) / over,
                tolerance);
    EXPECT_NEAR(r.t0, (b.t0 - a.t0) / over, tolerance);
    EXPECT_NEAR(r.tf, (b.tf - a.tf) / over, tolerance);
    compare(r.states, a.states, b.states, over, tolerance);
    compare(r.controls, a.controls, b.controls, over, tolerance);
  }
}

TEST(PhasedSensitivity, AgreesWithDifferences) {
  const std::vector<std::pair<std::string, double Numbers::*>> all = {
      {"first: mass", &Numbers::mass},
      {"mass", &Numbers::mass},
      {"drag", &Numbers::drag},
      {"first: initial x", &Numbers::start},
      {"first: final x", &Numbers::hand_over},
      {"jump", &Numbers::jump}};
  for (const double floor : {0.0, 0.02}) {
    SCOPED_TRACE(floor);
    const double tolerance = floor > 0 ? 3e-5 : 2e-3, h = floor > 0 ? 1e-4 : 1e-5;
    const Numbers base;
    const PhasedSolution answer = solved(base, settings(floor));
    const PhasedSensitivities known(carts(base), answer);
    auto warm = settings(floor);
    warm.warm_start = answer.point;
    for (const auto& [name, member] : all) {
      SCOPED_TRACE(name);
      Numbers low = base, high = base;
      low.*member -= h;
      high.*member += h;
      compare(known(name), solved(low, warm), solved(high, warm), 2 * h, tolerance);
    }
  }
}

TEST(PhasedSensitivity, PredictsToSecondOrder) {
  const auto how = settings(0.02);
  const auto problem = carts({});
  const PhasedSensitivities known(problem, solved({}, how));
  double errors[2];
  for (const int halved : {0, 1}) {
    const double by = halved == 0 ? 8e-3 : 4e-3;
    const auto changed = with_numbers(
        problem, {{"drag", 0.2 + by}, {"mass", 1.3 - by}, {"first: initial x", 0.1 + by}});
    const PhasedSolution predicted = known.predict(changed), exact = solve(changed, how);
    ASSERT_TRUE(exact.solved());
    EXPECT_EQ(predicted.status, nlp::Status::iteration_limit);
    EXPECT_EQ(predicted.phases[0].state("x").front(), 0.1 + by);
    errors[halved] = std::fabs(predicted.phases[1].tf() - exact.phases[1].tf());
    for (const std::size_t p : {0, 1})
      for (std::size_t k = 0; k < exact.phases[p].time().size(); ++k)
        errors[halved] +=
            std::fabs(predicted.phases[p].state("v")[k] - exact.phases[p].state("v")[k]);
    for (std::size_t l = 0; l < exact.link_multipliers.size(); ++l)
      errors[halved] +=
          std::fabs(predicted.link_multipliers[l].second - exact.link_multipliers[l].second);
  }
  EXPECT_GT(errors[0], 1e-7);
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.4);
  EXPECT_TRUE(known.predict(problem).solved());
  Problem other = problem.phases()[0];
  other.enable_cost("effort", false);
  auto switched = problem;
  switched.replace(0, other);
  EXPECT_NE(refusal([&] { (void)known.predict(switched); }).find("effort switched"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              (void)with_numbers(problem, {{"jump", 1}});
            }).find("bound of a link"),
            std::string::npos);
}

TEST(PhasedSensitivity, ListsAndRefuses) {
  const auto problem = carts({});
  const auto numbers = sensitivity_numbers(problem);
  const auto has = [&](const std::string& name, double value) {
    return std::find(numbers.begin(), numbers.end(), std::pair(name, value)) != numbers.end();
  };
  EXPECT_TRUE(has("drag", 0.2) && has("second: drag", 0.2) && has("mass", 1.3));
  EXPECT_TRUE(has("second: upper v", 1.4) && has("jump", -0.15) && has("first: initial v", 0));
  EXPECT_FALSE(has("second: mass", 1.3));
  const PhasedSolution answer = solved({}, settings(0));
  EXPECT_EQ(refusal([&] { (void)PhasedSensitivities(problem, answer)("first: initial y"); }),
            "carts: sensitivities: found no number 'first: initial y', expected perhaps 'first: "
            "initial x'");
  Numbers other;
  other.jump = 0.1;
  EXPECT_NE(refusal([&] { PhasedSensitivities(carts(other), answer); }).find("other numbers"),
            std::string::npos);
}

}  // namespace
}  // namespace slalom::ocp
