// Transcriptions as formulas: the same functions as their numbers, and solved through a .nl file.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "nl_solver/nl_solver.hpp"
#include "ocp/closed_forms.hpp"
#include "ocp/kitchen_sink.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

void expect_same_functions(nlp::Problem& problem, const std::vector<double>& x) {
  const auto formulas = problem.formulas();
  ASSERT_TRUE(formulas);
  auto outputs = formulas->rows;
  outputs.push_back(formulas->objective);
  const expr::Function f(formulas->variables, {}, outputs);
  std::vector<double> values(outputs.size()), jacobian(f.jacobian_pattern().size());
  f.evaluate(1, x, {}, {}, {.values = true, .jacobian = true}, values, jacobian, {});
  nlp::Evaluation at;
  ASSERT_FALSE(problem.evaluate(x, 1, {}, {.values = true, .derivatives = true}, at));
  const auto& shape = problem.structure();
  EXPECT_NEAR(values.back(), at.objective, 1e-12 * (1 + std::fabs(at.objective)));
  for (std::size_t r = 0; r < shape.rows; ++r)
    EXPECT_NEAR(values[r], at.rows[r], 1e-12 * (1 + std::fabs(at.rows[r]))) << problem.row_name(r);
  std::map<std::pair<std::size_t, std::size_t>, double> entries;
  for (std::size_t e = 0; e < at.jacobian.size(); ++e)
    entries[{shape.jacobian_row[e], shape.jacobian_col[e]}] += at.jacobian[e];
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    const auto [row, col] = f.jacobian_pattern()[e];
    if (row == shape.rows) {
      EXPECT_NEAR(jacobian[e], at.gradient[col], 1e-10 * (1 + std::fabs(at.gradient[col])));
      continue;
    }
    const auto known = entries.find({row, col});
    ASSERT_NE(known, entries.end()) << problem.row_name(row) << ", " << problem.variable_name(col);
    EXPECT_NEAR(jacobian[e], known->second, 1e-10 * (1 + std::fabs(known->second)));
    entries.erase(known);
  }
  for (const auto& [place, value] : entries) EXPECT_EQ(value, 0) << problem.row_name(place.first);
}

TEST(Formulas, AreWhatTheTranscriptionEvaluates) {
  const KitchenSink sink;
  for (const Scheme& scheme : {trapezoidal(), hermite_simpson(), lgr(3), lgr_differential(3)}) {
    SCOPED_TRACE(scheme.name);
    Transcription transcription(sink.problem, Mesh({0, 0.2, 0.7, 1}), scheme);
    expect_same_functions(transcription, some_point(transcription));
  }
}

/// Least effort over two phases, the second with states in other units.
PhasedProblem two_phases() {
  PhasedProblem both("two");
  Problem first("first"), second("second");
  for (Problem* p : {&first, &second}) {
    const Expr x = p->state("x", {-2, 2}, p == &first ? 1 : 0.5), v = p->state("v");
    const Expr u = p->control("u");
    p->dynamics(x, v);
    p->dynamics(v, u - 0.1 * v * abs(v));
    p->lagrange("effort", square(u));
    if (p == &first) {
      p->initial_bounds(x, Bounds::equal(0));
      p->initial_bounds(v, Bounds::equal(0));
      p->final_bounds(x, Bounds::at_least(0.8));
    } else {
      p->initial_time(Bounds::equal(1), 1);
      p->final_time({1.5, 2.5}, 2);
      p->final_bounds(x, Bounds::equal(0));
      p->final_bounds(v, Bounds::equal(0));
    }
  }
  both.add(first);
  both.add(second);
  both.connect(0, 1);
  return both;
}

TEST(Formulas, AreWhatPhasesEvaluate) {
  PhasedTranscription transcription(
      two_phases(), {{Mesh::uniform(3), lgr(3)}, {Mesh::uniform(2), hermite_simpson()}});
  expect_same_functions(transcription, some_point(transcription));
}

void expect_same_point(const nlp::Start& point, const nlp::Start& expected) {
  double largest = 1;
  for (const double y : expected.y) largest = std::max(largest, std::fabs(y));
  for (std::size_t i = 0; i < expected.x.size(); ++i)
    EXPECT_NEAR(point.x[i], expected.x[i], 2e-6 * (1 + std::fabs(expected.x[i]))) << i;
  for (std::size_t r = 0; r < expected.y.size(); ++r)
    EXPECT_NEAR(point.y[r], expected.y[r], 1e-5 * largest) << r;
}

TEST(Nl, ClosedFormsAreSolvedAsByOurOwnMethod) {
  SLALOM_NEEDS_NL_SOLVER();
  for (const auto& form : {bryson_denham(1.0 / 9), bryson_denham(0.5), least_energy()}) {
    SCOPED_TRACE(form.name);
    SolveSettings settings;
    settings.mesh = Mesh::uniform(10);
    settings.options.tol = 1e-9;
    settings.options.constraint_tol = 1e-8;
    const Solution ours = solve(form.problem, settings);
    settings.backend = "nl";
    settings.options.nl_solver = nl_solver();
    const Solution theirs = solve(form.problem, settings);
    ASSERT_TRUE(ours.solved());
    ASSERT_TRUE(theirs.solved()) << theirs.residuals.worst_constraint;
    EXPECT_NEAR(theirs.objective, ours.objective, 1e-6 * std::fabs(ours.objective));
    expect_same_point(theirs.point, ours.point);
  }
}

TEST(Nl, PhasesAreSolvedAsByOurOwnMethod) {
  SLALOM_NEEDS_NL_SOLVER();
  PhasedSettings settings;
  settings.grids = {{Mesh::uniform(5), lgr(4)}, {Mesh::uniform(6), hermite_simpson()}};
  settings.options.tol = 1e-9;
  settings.options.constraint_tol = 1e-8;
  const auto ours = solve(two_phases(), settings);
  settings.backend = "nl";
  settings.options.nl_solver = nl_solver();
  const auto theirs = solve(two_phases(), settings);
  ASSERT_TRUE(ours.solved());
  ASSERT_TRUE(theirs.solved()) << theirs.residuals.worst_constraint;
  EXPECT_NEAR(theirs.objective, ours.objective, 1e-6 * std::fabs(ours.objective));
  expect_same_point(theirs.point, ours.point);
}

}  // namespace
}  // namespace slalom::ocp
