#include "slalom/ocp/phases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

/// A stretch of the double integrator with |u| <= 1.
struct Stretch {
  Problem problem;
  Expr x, v, u;

  Stretch(const std::string& name, Bounds push)
      : problem(name), x(problem.state("x")), v(problem.state("v")), u(problem.control("u", push)) {
    problem.dynamics(x, v);
    problem.dynamics(v, u);
  }
};

/// Least time from rest to rest over 1, the switch of the control an end between two phases whose
/// times are free: the control of each is constant.
PhasedProblem least_time_in_two() {
  Stretch ahead("ahead", {0, 1}), back("back", {-1, 0});
  ahead.problem.initial_bounds(ahead.x, Bounds::equal(0));
  ahead.problem.initial_bounds(ahead.v, Bounds::equal(0));
  ahead.problem.final_time({0.1, 5}, 0.7);
  back.problem.initial_time({0.1, 5}, 0.7);
  back.problem.final_time({0.1, 10}, 1.5);
  back.problem.final_bounds(back.x, Bounds::equal(1));
  back.problem.final_bounds(back.v, Bounds::equal(0));
  back.problem.mayer("arrival", back.problem.final_time());
  PhasedProblem both("least time in two phases");
  both.add(ahead.problem);
  both.add(back.problem);
  both.connect(0, 1);
  return both;
}

TEST(Phases, TheSwitchOfABangBangControlIsAnEndOfTheirs) {
  for (const std::string& backend : nlp::backends())
    for (const Scheme& scheme : {backward_euler(), trapezoidal(), hermite_simpson(), lgr(3)}) {
      SCOPED_TRACE(scheme.name + " by " + backend);
      PhasedSettings settings;
      settings.grids = {{Mesh::uniform(3), scheme}, {Mesh::uniform(4), scheme}};
      settings.backend = backend;
      const PhasedSolution solution = solve(least_time_in_two(), settings);
      ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
      // Schemes of higher order keep u within its bounds at their points alone, and gain a little.
      if (scheme.order > 2) EXPECT_NEAR(solution.objective, 2, 1e-2);
      if (scheme.order == 2) {
        EXPECT_NEAR(solution.objective, 2, 1e-6);
        EXPECT_NEAR(solution.phases[0].tf(), 1, 1e-5);
        EXPECT_NEAR(solution.phases[1].state("x").front(), 0.5, 1e-5);
      }
      EXPECT_NEAR(solution.phases[0].tf(), solution.phases[1].trajectory.t0, 1e-8);
      EXPECT_EQ(solution.phases[0].state("x").size(), 3 * (scheme.interior() + 1) + 1);
    }
}

/// The regulator cut in `count` equal phases: with Hermite-Simpson the same NLP solution as in one.
PhasedProblem cut_regulator(int count) {
  PhasedProblem all("regulator in pieces");
  for (int k = 0; k < count; ++k) {
    Problem p("piece " + std::to_string(k));
    const Expr x = p.state("x"), u = p.control("u");
    p.dynamics(x, u);
    p.lagrange("cost", (square(x) + square(u)) / 2);
    p.initial_time(Bounds::equal(static_cast<double>(k) / count), 0);
    p.final_time(Bounds::equal((k + 1.0) / count), 1);
    if (k == 0) p.initial_bounds(x, Bounds::equal(1));
    all.add(p);
    if (k > 0)
      all.link("x into piece " + std::to_string(k),
               all.phases()[k - 1].states()[0].final_symbol - p.states()[0].initial_symbol);
  }
  return all;
}

TEST(Phases, PiecesOfAProblemAddUp) {
  const auto whole = regulator();
  for (const int count : {1, 2, 5}) {
    PhasedSettings settings;
    settings.grids.assign(static_cast<std::size_t>(count), {Mesh::uniform(8), hermite_simpson()});
    const PhasedSolution solution = solve(cut_regulator(count), settings);
    ASSERT_TRUE(solution.solved()) << count;
    EXPECT_NEAR(solution.objective, whole.objective, 1e-5);
    double sum = 0;
    for (const auto& phase : solution.phases) sum += phase.objective;
    EXPECT_NEAR(sum, solution.objective, 1e-12);
    for (const auto& phase : solution.phases)
      EXPECT_NEAR(phase.costate("x").front(), whole.costates(phase.trajectory.t0)[0], 1e-4);
    // Raising the link by d takes d off the next phase's begin: -(dJ/dx) there, sign of Start.
    for (std::size_t l = 0; l < solution.link_multipliers.size(); ++l)
      EXPECT_NEAR(std::fabs(solution.link_multipliers[l].second),
                  std::fabs(whole.costates((l + 1.0) / count)[0]), 1e-4);
  }
}

TEST(Phases, LinksMayBeNonlinearAndInequalities) {
  // Two half turns of a unit circle's point at free speeds; the product of both durations is held.
  PhasedProblem both("products");
  Problem a("a"), b("b");
  for (Problem* p : {&a, &b}) {
    const Expr x = p->state("x"), u = p->control("u", {0.1, 10});
    p->dynamics(x, u);
    p->lagrange("effort", square(u) / 2);
    p->initial_bounds(x, Bounds::equal(0));
    p->final_bounds(x, Bounds::equal(1));
    p->final_time({0.1, 10}, 1);
  }
  both.add(a);
  both.add(b);
  both.link("product of durations", a.final_time() * b.final_time(), Bounds::at_most(4));
  both.link("sum of squares", square(a.final_time()) + square(b.final_time()), Bounds::at_most(10));
  const PhasedSolution solution = solve(both);
  ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
  // Effort 1 / (2 T): least for T1 T2 = 4 with T1 = T2, by convexity.
  EXPECT_NEAR(solution.phases[0].tf(), 2, 1e-3);
  EXPECT_NEAR(solution.phases[1].tf(), 2, 1e-3);
  EXPECT_NEAR(solution.objective, 0.5, 1e-6);
}

TEST(Phases, ACostMayJoinWhatNoLinkDoes) {
  // From 1 to where it costs least, three pieces apart: effort u^2 over 3 s and (x(0) - 2 x(3))^2.
  PhasedProblem all("far apart");
  for (int k = 0; k < 3; ++k) {
    Problem p("piece " + std::to_string(k));
    const Expr x = p.state("x"), u = p.control("u");
    p.dynamics(x, u);
    p.lagrange("effort", square(u));
    p.initial_time(Bounds::equal(k), k);
    p.final_time(Bounds::equal(k + 1), k + 1);
    if (k == 0) p.initial_bounds(x, Bounds::equal(1));
    all.add(p);
  }
  all.connect(0, 1);
  all.connect(1, 2);
  const auto& phases = all.phases();
  all.mayer("ends",
            square(phases[0].states()[0].initial_symbol - 2 * phases[2].states()[0].final_symbol));
  const PhasedSolution solution = solve(all);
  ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
  // With x(3) = 1 + d: d^2 / 3 + (1 + 2 d)^2 is least at d = -6 / 13, and 1 / 13 there.
  EXPECT_NEAR(solution.phases[2].state("x").back(), 7.0 / 13, 1e-6);
  EXPECT_NEAR(solution.objective, 1.0 / 13, 1e-8);
  ASSERT_EQ(solution.cost_terms.size(), 1u);
  EXPECT_NEAR(solution.cost_terms[0].second, 1.0 / 169, 1e-6);
}

TEST(Phases, ASharedConstantIsOneAndTheSame) {
  PhasedProblem both("shared");
  for (int k = 0; k < 3; ++k) {
    Problem p("p" + std::to_string(k));
    const Expr x = p.state("x"), speed = p.static_parameter("speed", {-10, 10}, 1);
    p.dynamics(x, speed);
    p.lagrange("off", square(x - k));
    p.initial_bounds(x, Bounds::equal(0));
    both.add(p);
  }
  EXPECT_NE(refusal([&] { both.share("sped"); }).find("perhaps 'speed'"), std::string::npos);
  both.share("speed");
  const PhasedSolution solution = solve(both);
  ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
  // The integrals of (c t - k)^2 over k = 0, 1, 2 are c^2 - 3 c + 5 together: least at c = 3 / 2.
  for (const auto& phase : solution.phases) EXPECT_NEAR(phase.static_parameter("speed"), 1.5, 1e-6);
  EXPECT_NEAR(solution.objective, 2.75, 1e-6);
}

TEST(Phases, DerivativesOfLinksMatchDifferences) {
  PhasedProblem problem = cut_regulator(3);
  const auto& phases = problem.phases();
  problem.link("odd", sin(phases[0].states()[0].final_symbol * phases[2].states()[0].final_symbol),
               {-2, 2});
  problem.link("same phase", square(phases[1].states()[0].final_symbol), {-2, 9});
  problem.mayer("far apart",
                sin(phases[0].states()[0].initial_symbol * phases[2].states()[0].final_symbol));
  PhasedTranscription t(problem, {{Mesh::uniform(2)}, {Mesh::uniform(3)}, {Mesh::uniform(1)}});
  const auto& shape = t.structure();
  std::vector<double> x(shape.variables), y(shape.rows);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.3 + 0.1 * std::sin(1.0 + 3 * double(i));
  for (std::size_t r = 0; r < y.size(); ++r) y[r] = std::cos(2.0 * double(r));
  const auto gradient = [&](const std::vector<double>& at) {
    nlp::Evaluation e;
    EXPECT_FALSE(t.evaluate(at, 1, y, {true, true, false}, e));
    auto g = e.gradient;
    for (std::size_t k = 0; k < e.jacobian.size(); ++k)
      g[shape.jacobian_col[k]] += y[shape.jacobian_row[k]] * e.jacobian[k];
    return g;
  };
  nlp::Evaluation e;
  ASSERT_FALSE(t.evaluate(x, 1, y, {true, true, true}, e));
  std::vector<double> dense(x.size() * x.size(), 0.0);
  for (std::size_t k = 0; k < e.hessian.size(); ++k) {
    const std::size_t i = shape.hessian_row[k], j = shape.hessian_col[k];
    EXPECT_GE(i, j);
    dense[i * x.size() + j] += e.hessian[k];
    if (i != j) dense[j * x.size() + i] += e.hessian[k];
  }
  const double h = 1e-6;
  for (std::size_t j = 0; j < x.size(); ++j) {
    auto up = x, down = x;
    up[j] += h;
    down[j] -= h;
    const auto a = gradient(up), b = gradient(down);
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(dense[i * x.size() + j], (a[i] - b[i]) / (2 * h), 1e-7)
          << t.variable_name(i) << ", " << t.variable_name(j);
  }
}

/// Two stretches from rest, in whose guess the second ends where it begins, at 0.
TEST(Phases, DerivativesOfLinksAndCostsAreFiniteOrAFault) {
  const auto two = [] {
    Stretch a("a", {-1, 1}), b("b", {-1, 1});
    a.problem.initial_bounds(a.x, Bounds::equal(0));
    PhasedProblem both("both");
    both.add(a.problem);
    both.add(b.problem);
    both.connect(0, 1, {.without = {"time"}});
    return both;
  };
  const auto fault = [](PhasedProblem both, nlp::Parts parts) {
    PhasedTranscription t(both, {{Mesh::uniform(2)}, {Mesh::uniform(2)}});
    const std::vector<double> x(t.structure().variables, 0.0), y(t.structure().rows, 1.0);
    nlp::Evaluation at;
    return t.evaluate(x, 1, y, parts, at);
  };
  const auto end = [](const PhasedProblem& both) {
    return both.phases()[1].states()[0].final_symbol;
  };
  PhasedProblem root = two(), power = two(), linked = two();
  root.mayer("harmless", square(end(root)));
  root.mayer("root", sqrt(end(root)));
  const auto slope = fault(root, {.values = true, .derivatives = true});
  EXPECT_EQ(slope.function, "cost root");
  EXPECT_EQ(slope.variable, "b: x at node 2");
  EXPECT_FALSE(fault(root, {.values = true}));
  power.mayer("harmless", square(end(power)));
  power.mayer("power", pow(end(power), 1.5));
  EXPECT_FALSE(fault(power, {.values = true, .derivatives = true}));
  const auto curvature = fault(power, {.hessian = true});
  EXPECT_EQ(curvature.function, "cost power");
  EXPECT_EQ(curvature.variable, "b: x at node 2, b: x at node 2");
  linked.link("bent", pow(end(linked), 1.5), {-1, 1});
  EXPECT_EQ(fault(linked, {.hessian = true}).function, "link bent");
}

/// An infinite slope gave the objective a factor of 0, and an answer whose objective was NaN.
TEST(Phases, ACostThatIsNotSmoothAtTheGuessEndsTheSolve) {
  Stretch a("a", {-1, 1}), b("b", {-1, 1});
  a.problem.initial_bounds(a.x, Bounds::equal(0));
  b.problem.final_bounds(b.x, Bounds::equal(0));
  PhasedProblem both("both");
  both.add(a.problem);
  both.add(b.problem);
  both.connect(0, 1, {.without = {"time"}});
  both.mayer("root", sqrt(both.phases()[1].states()[0].initial_symbol));
  const PhasedSolution solution = solve(both);
  EXPECT_EQ(solution.status, nlp::Status::invalid_number);
  EXPECT_EQ(solution.fault.function, "cost root");
}

TEST(Phases, GlobalsOfAPhaseAreAtItsLastStage) {
  PhasedTranscription t(least_time_in_two(), {{Mesh::uniform(3)}, {Mesh::uniform(4)}});
  const auto& shape = t.structure();
  EXPECT_EQ(shape.stages, 4u + 5u);
  for (std::size_t i = 0; i < shape.variables; ++i) {
    EXPECT_LT(shape.variable_stage[i], shape.stages) << "the border is empty";
    const std::string name = t.variable_name(i);
    if (name == "ahead: tf") EXPECT_EQ(shape.variable_stage[i], 3u);
    if (name == "back: tf") EXPECT_EQ(shape.variable_stage[i], 8u);
  }
}

TEST(Phases, ErrorsSayWhatAndTheRule) {
  Stretch a("a", {-1, 1}), b("b", {-1, 1});
  PhasedProblem both("both");
  EXPECT_EQ(refusal([&] { PhasedTranscription(both, {}); }),
            "both: found no phases, expected at least one");
  both.add(a.problem);
  EXPECT_EQ(refusal([&] { both.add(a.problem); }),
            "both: found the phase 'a' twice, expected names that differ");
  both.add(b.problem);
  EXPECT_EQ(refusal([&] {
              PhasedTranscription(both, {{}, {}});
            }),
            "both: phase a: found no link, expected a link with another phase");
  EXPECT_EQ(refusal([&] { both.connect(0, 2); }),
            "both: connect: found phase 2, expected one of the 2 phases, from 0");
  both.connect(0, 1);
  EXPECT_EQ(refusal([&] { PhasedTranscription(both, {{}}); }),
            "both: grids: found 1, expected 2, one for each phase");
  EXPECT_EQ(refusal([&] { both.link("x from a to b", a.x); }),
            "both: found the link 'x from a to b' twice, expected names that differ");
  both.link("inside", a.x - 1);
  EXPECT_EQ(refusal([&] {
              PhasedTranscription(both, {{}, {}});
            }),
            "both: links and cost terms: found the symbol 'x', expected end values, times, static "
            "parameters and integrals of its phases");
  Problem other("other");
  (void)other.state("z");
  PhasedProblem strangers("strangers");
  strangers.add(a.problem);
  strangers.add(other);
  EXPECT_EQ(refusal([&] { strangers.connect(0, 1); }),
            "strangers: connect: found no state of a that other has too, expected states of the "
            "same name, or links of their own");
}

/// A row of path() or boundary() without bounds is refused; a link is an equation by its nature.
TEST(Phases, ALinkWithoutBoundsEqualsZero) {
  Stretch a("a", {-1, 1});
  PhasedProblem one("one");
  one.add(a.problem);
  one.link("equation", a.problem.final_time() - 1);
  EXPECT_EQ(one.links().front().bounds.lower, 0);
  EXPECT_EQ(one.links().front().bounds.upper, 0);
  EXPECT_EQ(refusal([&] { one.link("free", a.problem.final_time(), {}); }),
            "one: link free: found no bounds, expected a lower or upper bound, or a number that it "
            "equals");
  EXPECT_EQ(refusal([&] {
              one.link("none", a.problem.final_time(), {1, 0});
            }),
            "one: link none: found bounds 1 to 0, expected a lower bound not above the upper one");
  EXPECT_EQ(one.links().size(), 1u);
}

/// All links of a connection, or none where one is refused.
TEST(Phases, ARefusedConnectionLeavesNoLinks) {
  Stretch a("a", {-1, 1}), b("b", {-1, 1});
  PhasedProblem both("both");
  both.add(a.problem);
  both.add(b.problem);
  both.link("time from a to b", a.problem.final_time() - b.problem.initial_time());
  EXPECT_NE(refusal([&] { both.connect(0, 1); }), "accepted");
  EXPECT_EQ(both.links().size(), 1u);
  EXPECT_EQ(refusal([&] { both.connect(0, 1, {{"time"}, {}}); }), "accepted");
}

}  // namespace
}  // namespace slalom::ocp
