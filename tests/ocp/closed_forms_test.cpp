// Problems solved on paper, by every scheme and every back end; and the orders of convergence.

#include "ocp/closed_forms.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "ocp/orders.hpp"

namespace slalom::ocp {
namespace {

TEST(ClosedForms, EverySchemeAndBackEndFindsThem) {
  for (const auto& backend : nlp::backends())
    for (const auto& form : closed_forms())
      for (const Scheme& scheme : {trapezoidal(), hermite_simpson(), hermite_simpson_compressed(),
                                   backward_euler(), lgr(3), lgr_differential(3), lgl(4)}) {
        SCOPED_TRACE(form.name + " by " + scheme.name + " with " + backend);
        const Solution solution = solve(
            form.problem,
            {.mesh = Mesh::uniform(30), .scheme = scheme, .backend = backend, .guess = form.guess});
        EXPECT_TRUE(solution.solved())
            << to_string(solution.status) << ", " << solution.residuals.worst_constraint;
        const double share = scheme.order == 1    ? 0.1
                             : scheme.order == 2  ? 2e-2
                             : form.limit.empty() ? 1e-7
                                                  : 1e-2;
        EXPECT_NEAR(solution.objective, form.objective, share * form.objective);
      }
}

TEST(ClosedForms, BrysonDenhamForAllThreeKindsOfBound) {
  for (const double l : {0.04, 0.1, 1.0 / 9, 1.0 / 6, 0.2, 0.24, 0.25, 0.3, 1.0}) {
    const auto form = bryson_denham(l);
    const Solution solution = solve(form.problem, {.mesh = Mesh::uniform(60)});
    ASSERT_TRUE(solution.solved()) << l;
    EXPECT_NEAR(solution.objective, form.objective, 1e-3 * form.objective) << l;
    const auto x = solution.state("x");
    EXPECT_LE(*std::max_element(x.begin(), x.end()), l + 1e-8);
  }
}

TEST(ClosedForms, BangBangControlsSwitchOnce) {
  const Solution time = solve(least_time().problem);
  ASSERT_TRUE(time.solved());
  const auto u = time.control("u");
  EXPECT_NEAR(u.front(), 1, 1e-4);
  EXPECT_NEAR(u.back(), -1, 1e-4);
  EXPECT_NEAR(time.tf(), 2, 1e-3);
  const Solution moon = solve(moon_lander().problem);
  ASSERT_TRUE(moon.solved());
  EXPECT_NEAR(moon.control("u").front(), 0, 1e-4);
  EXPECT_NEAR(moon.control("u").back(), 3, 1e-4);
  EXPECT_NEAR(moon.tf(), 4.1641, 5e-3);
}

TEST(ClosedForms, CostatesHaveTheDocumentedSign) {
  // dJ*/dx of the regulator, by solving it from a neighbouring start.
  auto form = regulator();
  const auto cost_from = [&](double start) {
    const Expr x = form.problem.states()[0].symbol;
    form.problem.initial_bounds(x, Bounds::equal(start));
    return solve(form.problem);
  };
  const double slope = (cost_from(1.01).objective - cost_from(0.99).objective) / 0.02;
  EXPECT_NEAR(cost_from(1).costate("x").front(), slope, 1e-6);
}

TEST(ClosedForms, IntegralsMayBeBoundedAndUsed) {
  const auto form = isoperimetric();
  // As an inequality, and with the cost itself an integral that a Mayer term uses.
  Problem p("area at least");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u);
  const Expr area = p.integral("area", x, Bounds::at_least(0.5));
  const Expr effort = p.integral("effort", square(u) / 2);
  p.mayer("cost", effort + square(area - 0.5));
  fix(p, x, 0, 0);
  for (const Scheme& scheme : {trapezoidal(), hermite_simpson(), lgr(4), lgl(4)}) {
    const Solution solution = solve(p, {.mesh = Mesh::uniform(24), .scheme = scheme});
    SCOPED_TRACE(scheme.name);
    ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
    EXPECT_NEAR(solution.objective, form.objective, scheme.order == 2 ? 2e-2 : 1e-6);
    EXPECT_NEAR(solution.trajectory.integrals.at(0), 0.5, 1e-6);
    EXPECT_NEAR(solution.trajectory.integrals.at(1), solution.objective, 1e-6);
  }
}

TEST(ClosedForms, WarmStartFromTheSolution) {
  const auto form = brachistochrone();
  SolveSettings settings{.guess = form.guess};
  const Solution cold = solve(form.problem, settings);
  settings.warm_start = cold.point;
  const Solution warm = solve(form.problem, settings);
  ASSERT_TRUE(warm.solved());
  EXPECT_LT(warm.iterations, cold.iterations);
  EXPECT_NEAR(warm.objective, cold.objective, 1e-8);
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> list;
  for (std::string word; in >> word;) list.push_back(word);
  return list;
}

/// Equal words, or numbers that differ as rounding on another machine may make them.
bool agree(const std::string& a, const std::string& b) {
  if (a == b) return true;
  char* end = nullptr;
  const double x = std::strtod(a.c_str(), &end);
  if (*end != '\0') return false;
  const double y = std::strtod(b.c_str(), &end);
  if (*end != '\0') return false;
  return a.find('e') != std::string::npos ? std::fabs(std::log(x / y)) < 0.1
                                          : std::fabs(x - y) < 0.25;
}

TEST(Orders, AreTheSchemesOnesWhereTheSolutionIsSmoothAndTheCommittedTableHolds) {
  const auto table = measure_orders();
  for (const auto& row : table) {
    if (!row.limit.empty()) continue;
    for (const Order* order : {&row.objective, &row.states, &row.costates}) {
      if (!order->known || order->exact) continue;
      EXPECT_GE(order->value, row.expected - 0.5)
          << row.problem << ", " << row.scheme << ", " << row.mesh;
    }
  }
  std::ifstream file(SLALOM_SOURCE_DIR "/docs/convergence.md");
  ASSERT_TRUE(file) << "docs/convergence.md is missing";
  std::stringstream committed;
  committed << file.rdbuf();
  const auto have = words(committed.str()), want = words(order_page(table));
  ASSERT_EQ(have.size(), want.size()) << "run slalom_orders > docs/convergence.md";
  for (std::size_t i = 0; i < have.size(); ++i)
    EXPECT_TRUE(agree(have[i], want[i])) << "word " << i << ": " << have[i] << ", now " << want[i];
}

}  // namespace
}  // namespace slalom::ocp
