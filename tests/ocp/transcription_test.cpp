// Structure of transcriptions: what stands where, what is absent, what names and faults say.

#include "slalom/ocp/transcription.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ocp/kitchen_sink.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;
const Scheme* const kSchemes[] = {&trapezoidal(), &hermite_simpson()};

std::vector<std::string> row_names(const Transcription& t) {
  std::vector<std::string> names;
  for (std::size_t r = 0; r < t.structure().rows; ++r) names.push_back(t.row_name(r));
  return names;
}

std::size_t count(const std::vector<std::string>& names, const std::string& part) {
  return static_cast<std::size_t>(std::count_if(names.begin(), names.end(), [&](const auto& name) {
    return name.find(part) != std::string::npos;
  }));
}

std::size_t globals(const nlp::Structure& shape) {
  return static_cast<std::size_t>(
      std::count(shape.variable_stage.begin(), shape.variable_stage.end(), shape.stages));
}

TEST(Structure, RowsTouchTheirStageTheNextOrGlobals) {
  for (const Scheme* scheme : kSchemes) {
    KitchenSink sink;
    const Transcription t(sink.problem, Mesh::uniform(4), *scheme);
    const auto& shape = t.structure();
    ASSERT_EQ(shape.stages, 5u);
    ASSERT_EQ(shape.variable_stage.size(), shape.variables);
    ASSERT_EQ(shape.row_stage.size(), shape.rows);
    std::set<std::pair<std::uint32_t, std::uint32_t>> places;
    for (std::size_t e = 0; e < shape.jacobian_row.size(); ++e) {
      const std::size_t r = shape.jacobian_row[e], col = shape.jacobian_col[e];
      EXPECT_TRUE(places.emplace(r, col).second) << "each place once";
      if (shape.global(col)) continue;
      const std::size_t distance = shape.variable_stage[col] - shape.row_stage[r];
      const bool defect = t.row_name(r).starts_with("defect");
      EXPECT_LE(distance, defect ? 1u : 0u) << t.row_name(r) << " and " << t.variable_name(col);
    }
    for (std::size_t e = 0; e < shape.hessian_row.size(); ++e) {
      const std::size_t a = shape.hessian_row[e], b = shape.hessian_col[e];
      if (!shape.global(a) && !shape.global(b)) {
        EXPECT_EQ(shape.variable_stage[a], shape.variable_stage[b]);
      }
    }
  }
}

TEST(Structure, NumbersOfRowsAndVariables) {
  KitchenSink sink;
  const auto sizes = [&](const Scheme& scheme) {
    const Transcription t(sink.problem, Mesh::uniform(4), scheme);
    return std::pair{t.structure().variables, t.structure().rows};
  };
  // Globals: t0, tf, p, initial(x), final(x), final(y). Rows: 3 copies, start, end;
  // defects 2 an interval and inner point; wall at all points, band and 3 discs after the first.
  EXPECT_EQ(sizes(trapezoidal()),
            (std::pair<std::size_t, std::size_t>{2 + 5 * 4 + 6, 3 + 2 + 4 * 2 + 5 + 4 * (1 + 3)}));
  EXPECT_EQ(sizes(hermite_simpson()),
            (std::pair<std::size_t, std::size_t>{2 + 9 * 4 + 6, 3 + 2 + 8 * 2 + 9 + 8 * (1 + 3)}));
}

TEST(Structure, NamesAreUniqueAndSayWhere) {
  for (const Scheme* scheme : kSchemes) {
    KitchenSink sink;
    const Transcription t(sink.problem, Mesh({0, 0.2, 1}), *scheme);
    const auto rows = row_names(t);
    EXPECT_EQ(std::set<std::string>(rows.begin(), rows.end()).size(), rows.size());
    std::set<std::string> variables;
    for (std::size_t i = 0; i < t.structure().variables; ++i) variables.insert(t.variable_name(i));
    EXPECT_EQ(variables.size(), t.structure().variables);
    for (const char* name : {"s", "e", "t0", "tf", "p", "initial(x)", "final(x)", "final(y)",
                             "x at node 0", "y at node 2", "u at node 1", "w at node 2"})
      EXPECT_TRUE(variables.count(name)) << name;
    for (const char* name : {"start", "end", "copy of initial(x)", "defect 0 of x in interval 1",
                             "wall at node 0", "band at node 1", "disc[two] at node 2"})
      EXPECT_EQ(std::count(rows.begin(), rows.end(), name), 1) << name;
    EXPECT_EQ(count(rows, "at node 0"), 1u) << "band and disc stand after the first node only";
    const bool inner = scheme == &hermite_simpson();
    EXPECT_EQ(variables.count("u at point 1 of interval 0"), inner ? 1u : 0u);
    EXPECT_EQ(count(rows, "disc[one] at point 1 of interval 0"), inner ? 1u : 0u);
    EXPECT_EQ(count(rows, "defect 1 of y in interval 1"), inner ? 1u : 0u);
  }
}

TEST(Structure, DefectRowIsOfTheLastDefect) {
  for (const Scheme* scheme : kSchemes) {
    KitchenSink sink;
    const Transcription t(sink.problem, Mesh::uniform(3), *scheme);
    const std::string defect = "defect " + std::to_string(scheme->defects() - 1) + " of ";
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string where = " in interval " + std::to_string(k);
      EXPECT_EQ(t.row_name(t.defect_row(0, k)), defect + "x" + where);
      EXPECT_EQ(t.row_name(t.defect_row(1, k)), defect + "y" + where);
    }
  }
}

TEST(Structure, SwitchedOffIsAbsent) {
  KitchenSink sink;
  Problem& p = sink.problem;
  const auto rows = [&] { return row_names(Transcription(p, Mesh::uniform(4), trapezoidal())); };
  const auto all = rows();
  p.enable(sink.wall, false);
  EXPECT_EQ(count(rows(), "wall"), 0u);
  EXPECT_EQ(rows().size(), all.size() - 5);
  p.enable(sink.wall, true);
  EXPECT_EQ(rows(), all) << "and comes back";
  p.enable(sink.family, false);
  EXPECT_EQ(count(rows(), "disc"), 0u);
  p.enable(sink.family, true);
  p.set_members(sink.family, {}, {});
  EXPECT_EQ(count(rows(), "disc"), 0u) << "a family without members";
  p.enable(sink.start, false);
  EXPECT_EQ(count(rows(), "start"), 0u);

  const auto terms = [&] {
    Transcription t(p, Mesh::uniform(4), trapezoidal());
    std::string names;
    for (const auto& [name, value] : t.cost_terms(some_point(t))) names += name + ";";
    return names;
  };
  EXPECT_EQ(terms(), "effort;ends;start cost;");
  p.enable_cost("ends", false);
  p.enable_cost("unused", true);
  EXPECT_EQ(terms(), "effort;unused;start cost;");
}

TEST(Structure, ACopyNobodyUsesIsAbsent) {
  Problem p("copies");
  const Expr x = p.state("x", {-1, 1}), u = p.control("u");
  p.dynamics(x, u);
  const auto row = p.path("row", x - p.initial(x), {0, 1});
  const auto count_globals = [&] {
    return globals(Transcription(p, Mesh::uniform(2), trapezoidal()).structure());
  };
  EXPECT_EQ(count_globals(), 3u);  // t0, tf, initial(x)
  p.enable(row, false);
  EXPECT_EQ(count_globals(), 2u);
}

TEST(Structure, CostTermsSumToTheObjective) {
  for (const Scheme* scheme : kSchemes) {
    KitchenSink sink;
    Transcription t(sink.problem, Mesh({0, 0.3, 1}), *scheme);
    const Vector x = some_point(t);
    nlp::Evaluation at;
    t.evaluate(x, 1, {}, {.values = true}, at);
    double sum = 0;
    for (const auto& [name, value] : t.cost_terms(x)) sum += value;
    EXPECT_NEAR(sum, at.objective, 1e-12);
  }
}

TEST(Update, EqualsARebuild) {
  for (const Scheme* scheme : kSchemes) {
    KitchenSink sink;
    Transcription updated(sink.problem, Mesh::uniform(3), *scheme);
    const Vector x = some_point(updated);
    const Vector y(updated.structure().rows, 0.7);
    nlp::Evaluation before, after, rebuilt;
    const nlp::Parts all{.values = true, .derivatives = true, .hessian = true};
    updated.evaluate(x, 1, y, all, before);

    sink.problem.set_parameter(sink.q, -1.3);
    sink.problem.set_members(sink.family, {"a", "b", "c"}, {{2, 2}, {-5, 1}, {0.1, -4}});
    sink.problem.initial_bounds(sink.x, {-0.5, 0.5});
    sink.problem.final_time({2, 3}, 2.2);
    updated.update(sink.problem);
    Transcription fresh(sink.problem, Mesh::uniform(3), *scheme);
    updated.evaluate(x, 1, y, all, after);
    fresh.evaluate(x, 1, y, all, rebuilt);
    EXPECT_NE(before.rows, after.rows);
    EXPECT_EQ(after.objective, rebuilt.objective);
    EXPECT_EQ(after.rows, rebuilt.rows);
    EXPECT_EQ(after.jacobian, rebuilt.jacobian);
    EXPECT_EQ(after.hessian, rebuilt.hessian);
    EXPECT_EQ(updated.limits().xl, fresh.limits().xl);
    EXPECT_EQ(updated.limits().xu, fresh.limits().xu);
    EXPECT_EQ(row_names(updated), row_names(fresh)) << "members' new names too";
  }
}

TEST(Scaling, LeavesTheSolutionUnchanged) {
  const auto solve_scaled = [](double sx, double sv, double su, double floor) {
    Problem p("scaled");
    const Expr x = p.state("x", Bounds::at_most(0.12), sx), v = p.state("v", {}, sv);
    const Expr u = p.control("u", {-8, 8}, su);
    p.dynamics(x, v);
    p.dynamics(v, u - 0.3 * sin(v));
    p.lagrange("effort", square(u));
    p.initial_bounds(x, Bounds::equal(0));
    p.initial_bounds(v, Bounds::equal(1));
    p.final_bounds(x, Bounds::equal(0));
    p.final_bounds(v, Bounds::equal(-1));
    SolveSettings settings{.mesh = Mesh::uniform(10)};
    settings.options.floor = floor;
    return solve(p, settings);
  };
  for (const double floor : {0.0, 0.5}) {
    const Solution plain = solve_scaled(1, 1, 1, floor);
    const Solution scaled = solve_scaled(0.1, 3, 20, floor);
    ASSERT_TRUE(plain.solved());
    ASSERT_TRUE(scaled.solved());
    for (std::size_t k = 0; k < plain.trajectory.tau.size(); ++k) {
      EXPECT_NEAR(plain.state("x")[k], scaled.state("x")[k], 1e-4);
      EXPECT_NEAR(plain.control("u")[k], scaled.control("u")[k], 1e-2);
    }
    EXPECT_NEAR(plain.residuals.phi, scaled.residuals.phi, 1e-4 * std::fabs(plain.residuals.phi));
    for (std::size_t k = 0; k < plain.costates.size(); ++k)
      EXPECT_NEAR(plain.costate("v")[k], scaled.costate("v")[k], 2e-2) << k;
  }
}

TEST(Faults, NameFunctionPointAndVariable) {
  Problem p("faulty");
  const Expr x = p.state("x"), u = p.control("u");
  p.dynamics(x, u);
  const Expr a = Expr::symbol("a");
  const auto family = p.path_family("depth", {a}, sqrt(x - a), Bounds::at_least(0));
  p.set_members(family, {"shallow", "deep"}, {{-1}, {3}});
  Transcription t(p, Mesh::uniform(2), hermite_simpson());
  Trajectory guess = t.straight_guess();
  guess.states = {{5}, {1}};  // 5, 4, 3, 2, 1 at the points
  nlp::Evaluation at;
  nlp::Fault fault = t.evaluate(t.point(guess), 1, {}, {.values = true}, at);
  EXPECT_EQ(fault.function, "depth[deep]");
  EXPECT_EQ(fault.where, "point 1 of interval 1");
  EXPECT_EQ(fault.variable, "");
  fault = t.evaluate(t.point(guess), 1, {}, {.derivatives = true}, at);  // infinite at x = 3
  EXPECT_EQ(fault.function, "depth[deep]");
  EXPECT_EQ(fault.where, "node 1");
  EXPECT_EQ(fault.variable, "x");
  fault = t.evaluate(t.point(guess), 1, Vector(t.structure().rows, 1.0), {.hessian = true}, at);
  EXPECT_EQ(fault.function, "depth[deep]");
  EXPECT_EQ(fault.variable, "x, x");

  Problem q("faulty dynamics");
  const Expr y = q.state("y"), z = q.state("z");
  q.dynamics(y, z);
  q.dynamics(z, log(y));
  Transcription s(q, Mesh::uniform(3), trapezoidal());
  Trajectory down = s.straight_guess();
  down.states = {{1.5, 0}, {-1.5, 0}};
  fault = s.evaluate(s.point(down), 1, {}, {.values = true}, at);
  EXPECT_EQ(fault.function, "dynamics of z");
  EXPECT_EQ(fault.where, "node 2");
}

TEST(Guess, IsInterpolatedAndReadBack) {
  for (const Scheme* scheme : kSchemes) {
    KitchenSink sink;
    const Transcription t(sink.problem, Mesh({0, 0.5, 1}), *scheme);
    const Trajectory guess{
        0.1,   3.1,       {0, 0.25, 1}, {{0, 1}, {1, 1}, {4, -2}}, {{1, 0}, {2, 0}, {5, 0}},
        {2.5}, {0.4, 0.6}};
    const Trajectory back = t.trajectory(t.point(guess));
    EXPECT_DOUBLE_EQ(back.t0, 0.1);
    EXPECT_DOUBLE_EQ(back.tf, 3.1);
    EXPECT_DOUBLE_EQ(back.static_parameters[0], 2.5);
    EXPECT_EQ(back.slacks, (Vector{0.4, 0.6}));
    for (std::size_t k = 0; k < back.tau.size(); ++k) {
      const double tau = back.tau[k];
      EXPECT_NEAR(back.states[k][0], tau < 0.25 ? 4 * tau : 4 * tau, 1e-14);
      EXPECT_NEAR(back.states[k][1], tau < 0.25 ? 1 : 1 - 4 * (tau - 0.25), 1e-14);
      EXPECT_NEAR(back.controls[k][0], 1 + 4 * tau, 1e-14);
      EXPECT_DOUBLE_EQ(back.time(k), 0.1 + tau * 3);
    }
  }
}

TEST(Guess, StraightLinesBetweenTheBounds) {
  Problem p("guess");
  const Expr a = p.state("a", {-1, 3}), b = p.state("b", Bounds::at_least(2)), c = p.state("c");
  const Expr u = p.control("u", {0, 4});
  for (const Expr& state : {a, b, c}) p.dynamics(state, u);
  p.initial_bounds(c, Bounds::equal(-7));
  p.final_bounds(a, Bounds::equal(0.5));
  const Transcription t(p, Mesh::uniform(2), trapezoidal());
  const Trajectory guess = t.trajectory(t.point(t.straight_guess()));
  EXPECT_EQ(guess.states[0], (Vector{1, 2, -7}));
  EXPECT_EQ(guess.states[1], (Vector{0.75, 2, -3.5}));
  EXPECT_EQ(guess.states[2], (Vector{0.5, 2, 0}));
  EXPECT_EQ(guess.controls[1], (Vector{2}));
}

}  // namespace
}  // namespace slalom::ocp
