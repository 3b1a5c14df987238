// Problems that the interior-point method lost its way in, each for a reason of its own.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ocp/pushed_mass.hpp"
#include "slalom/ocp/errors.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

/// x' = tf u from 0 to 1, cost tf + integral of u^2 / 2: u = 1 / tf^2, tf = 1.5^(1/4).
Problem bolza(double guess) {
  Problem p("bolza");
  const Expr x = p.state("x"), u = p.control("u");
  p.final_time({0.01, 50}, guess);
  p.dynamics(x, p.final_time() * u);
  p.fix(x, 0, 1);
  p.mayer("duration", p.final_time());
  p.lagrange("effort", square(u) / 2);
  return p;
}

/// The first step of the adaptive rule goes to tf's lower bound, with mu next to zero.
TEST(HardStarts, TheAdaptiveRuleFallsBackInTime) {
  for (const double guess : {0.5, 1.0, 2.0, 10.0, 25.005}) {
    SCOPED_TRACE(guess);
    const Solution solution = solve(bolza(guess));
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.tf(), std::pow(1.5, 0.25), 1e-6);
    EXPECT_LE(solution.iterations, 50);
  }
}

/// What each bound's complementarity adds to the objective adds up: not to more on a finer mesh.
TEST(HardStarts, AFineMeshIsNoWorse) {
  Problem p = PushedMass("least time").problem;
  p.final_time({0.1, 10}, 5);
  p.mayer("duration", p.final_time());
  for (const int intervals : {40, 400, 4000}) {
    const Solution solution = solve(p, {.mesh = Mesh::uniform(intervals)});
    EXPECT_TRUE(solution.solved());
    EXPECT_NEAR(solution.tf(), 2, 1.8e-5) << intervals;
  }
}

/// Of many controls each meets few others: they are eliminated one by one, and not as one dense
/// front of a stage, whose work grows with the cube of their number.
TEST(HardStarts, ManyControlsAreEliminatedByThemselves) {
  for (const int count : {20, 200}) {
    Problem p("many");
    const Expr x = p.state("x"), v = p.state("v");
    Expr force = 0, effort = 0;
    for (int i = 0; i < count; ++i) {
      const Expr u = p.control("u" + std::to_string(i), {0, 1});
      force += i < count / 2 ? u : -u;
      effort += square(u);
    }
    p.dynamics(x, v);
    p.dynamics(v, force / (count / 2.0) * 20);
    p.fix(x, 0, 1);
    p.fix(v, 0, 0);
    p.lagrange("effort", effort / (count / 2.0));
    const Solution solution = solve(p);
    EXPECT_TRUE(solution.solved());
    EXPECT_NEAR(solution.objective, 0.03, 1e-6);  // 12 / 20^2
    EXPECT_EQ(solution.backend,
              count == 20 ? "interior_point/stage_ldlt" : "interior_point/sparse_ldlt");
  }
}

/// A chain of length 4 hanging between two points, which an integral says and not a state. Its
/// potential energy is convex along chains of that length alone, which the row at the end says.
TEST(HardStarts, ALengthMayBeAnIntegral) {
  Problem p("chain");
  const Expr x = p.state("x"), u = p.control("u"), length = sqrt(1 + square(u));
  p.dynamics(x, u);
  p.fix(x, 1, 3);
  p.integral("length", length, Bounds::equal(4));
  p.lagrange("energy", x * length);
  const Guess sag = Guess(p)
                        .function("x", [](double t) { return 1 - 6 * t + 8 * t * t; })
                        .function("u", [](double t) { return -6 + 16 * t; });
  const Solution solution =
      solve(p, {.mesh = Mesh::uniform(40), .scheme = trapezoidal(), .guess = sag});
  EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
  EXPECT_NEAR(solution.objective, 5.0737792, 1e-6);  // of this mesh; the catenary has 5.0684805
  EXPECT_LE(solution.iterations, 20);
}

/// Penicillin in a fed batch (J. E. Cuthrell and L. T. Biegler, Comput. Chem. Eng. 13(1-2), 1989;
/// 87.948 by R. Luus, Iterative Dynamic Programming, 2000): the adaptive rule ends in corners.
TEST(HardStarts, AMonotoneBarrierIsTriedLast) {
  Problem p("penicillin");
  const Expr X = p.state("X", {0, 40}), P = p.state("P", {0, 50}), S = p.state("S", {0, 25});
  const Expr V = p.state("V", {0, 10}), u = p.control("u", {0, 50});
  const Expr grown = 0.11 * S / (0.006 * X + S), made = 0.0055 * S / (0.0001 + S * (1 + 10 * S));
  p.dynamics(X, grown * X - u * X / 500 / V);
  p.dynamics(P, made * X - 0.01 * P - u * P / 500 / V);
  p.dynamics(
      S, -grown * X / 0.47 - made * X / 1.2 - X * 0.029 * S / (0.0001 + S) + u / V * (1 - S / 500));
  p.dynamics(V, u / 500);
  p.initial_bounds(X, Bounds::equal(1.5));
  p.initial_bounds(P, Bounds::equal(0));
  p.initial_bounds(S, Bounds::equal(0));
  p.initial_bounds(V, Bounds::equal(7));
  p.final_time({72, 200}, 136);
  p.mayer("yield", -p.final(P) * p.final(V));
  for (const int intervals : {20, 40, 80}) {
    const Solution solution = solve(p, {.mesh = Mesh::uniform(intervals), .scheme = lgr(4)});
    EXPECT_TRUE(solution.solved()) << intervals << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.objective, -87.9, 0.3) << intervals;
  }
}

/// Two stages of a rocket straight up, the second's mass bounded by what it begins with: the link
/// that says so leaves that bound no interior.
PhasedProblem two_stages() {
  PhasedProblem both("two stages");
  const double mass[] = {20, 5}, thrust[] = {400, 90}, flow[] = {1.2, 0.3};
  for (int i = 0; i < 2; ++i) {
    Problem p(i == 0 ? "one" : "two");
    const Expr h = p.state("h", {0, kInfinity}), v = p.state("v"), m = p.state("m", {1, mass[i]});
    const Expr u = p.control("u", {0, 1});
    p.dynamics(h, v);
    p.dynamics(v, thrust[i] * u / m - 9.81 - 0.001 * square(v) / m);
    p.dynamics(m, -flow[i] * u);
    if (i == 0) {
      p.initial_bounds(h, Bounds::equal(0));
      p.initial_bounds(v, Bounds::equal(0));
      p.initial_bounds(m, Bounds::equal(mass[0]));
      p.final_time(Bounds::equal(10), 10);
    } else {
      p.initial_time(Bounds::equal(10), 10);
      p.final_time({11, 40}, 20);
      p.final_bounds(h, Bounds::equal(2500));
      p.mayer("mass", -p.final(m));
    }
    both.add(p);
  }
  both.connect(0, 1, {.without = {"m"}});
  both.link("dropped", both.phases()[1].initial(both.phases()[1].states()[2].symbol),
            Bounds::equal(mass[1]));
  return both;
}

TEST(HardStarts, ABoundThatALinkHoldsHasNoInterior) {
  std::vector<double> found;
  for (const std::string& backend : nlp::backends()) {
    PhasedSettings settings;
    settings.grids.assign(2, {Mesh::uniform(10), hermite_simpson()});
    settings.backend = backend;
    const PhasedSolution solution = solve(two_stages(), settings);
    EXPECT_TRUE(solution.solved()) << backend << ": " << nlp::to_string(solution.status);
    EXPECT_LE(solution.iterations, 100) << backend;
    found.push_back(solution.objective);
  }
  for (const double each : found) EXPECT_NEAR(each, found.front(), 1e-5);
}

/// Of v² cos² + v² sin² only rounding is left of a slope: multiplied until that is 1, it led
/// nowhere.
TEST(HardStarts, RoundingOfAConstantObjectiveIsNoSlope) {
  Problem p("obstacles");
  const Expr x = p.state("x", {0, 2}), y = p.state("y", {0, 2}), a = p.control("a", {-10, 10});
  const Expr vx = 2.138 * cos(a), vy = 2.138 * sin(a);
  p.dynamics(x, vx);
  p.dynamics(y, vy);
  p.fix(x, 0, 1.2);
  p.fix(y, 0, 1.6);
  p.path("first", square(x - 0.4) + square(y - 0.5), Bounds::at_least(0.1));
  p.path("second", square(x - 0.8) + square(y - 1.5), Bounds::at_least(0.1));
  p.lagrange("effort", square(vx) + square(vy));
  const Solution solution = solve(p, {.guess = Guess(p).constant("a", 1)});
  EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
  EXPECT_LE(solution.iterations, 100);
}

/// Bryson & Ho 1975, section 2.7: the farthest slide in a given time. At rest, as in the guess, the
/// heading has no effect to first order, and the rows contradict each other.
Problem farthest_slide() {
  Problem p("farthest slide");
  const Expr x = p.state("x"), y = p.state("y"), v = p.state("v"), heading = p.control("heading");
  p.dynamics(x, v * cos(heading));
  p.dynamics(y, v * sin(heading));
  p.dynamics(v, 0.5 - sin(heading));
  for (const Expr& each : {x, y, v}) p.initial_bounds(each, Bounds::equal(0));
  p.final_bounds(y, Bounds::equal(0.1));
  p.final_time(Bounds::equal(2), 2);
  p.mayer("range", -p.final(x));
  return p;
}

/// Headings some full turns apart say the same at the points, but not between them.
TEST(HardStarts, FullTurnsOfAHeadingAreTakenOff) {
  Problem p = farthest_slide();
  const Solution solution = solve(p);
  ASSERT_TRUE(solution.solved()) << nlp::to_string(solution.status);
  EXPECT_NEAR(solution.objective, -1.7123149, 1e-6);
  const std::vector<double> heading = solution.control("heading");
  for (std::size_t k = 1; k < heading.size(); ++k)
    EXPECT_LE(std::fabs(heading[k] - heading[k - 1]), 3.2) << k;
  EXPECT_LE(estimate_errors(p, solution).largest, 1e-5);
  // The point is the trajectory's, and still meets all rows.
  const Solution again = solve(p, {.warm_start = solution.point});
  EXPECT_TRUE(again.solved());
  EXPECT_NEAR(again.objective, solution.objective, 1e-7);
}

/// Without a guess, a free final volume would go to 0 on a straight line.
TEST(HardStarts, AStateThatOneEndTellsIsHeldWhereALineFails) {
  Problem p("filling");
  const Expr v = p.state("v"), c = p.state("c"), u = p.control("u", {0, 1});
  p.dynamics(v, u);
  p.dynamics(c, (1 - c) * u / v);
  p.initial_bounds(v, Bounds::equal(1));
  p.initial_bounds(c, Bounds::equal(0));
  p.mayer("concentration", -p.final(c));
  const Solution solution = solve(p);
  EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
  EXPECT_NEAR(solution.objective, -0.5, 1e-6);  // c = 1 - 1 / v
}

/// Rayleigh's equation to rest in least time (Maurer & Augustin 2001): bang-bang, and on the whole
/// mesh the method loses its way from straight lines.
Problem rayleigh_in_least_time() {
  Problem p("rayleigh");
  const Expr x = p.state("x"), y = p.state("y"), u = p.control("u", {-1, 1});
  p.final_time({0.5, 20}, 3);
  p.dynamics(x, y);
  p.dynamics(y, -x + y * (1.4 - 0.14 * square(y)) + 4 * u);
  p.fix(x, -5, 0);
  p.fix(y, -5, 0);
  p.mayer("duration", p.final_time());
  return p;
}

TEST(HardStarts, WhatAFineMeshLosesACoarseOneFinds) {
  SolveSettings settings{.mesh = Mesh::uniform(20), .scheme = lgr(4)};
  const Solution solution = solve(rayleigh_in_least_time(), settings);
  EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
  EXPECT_NEAR(solution.tf(), 3.66817339, 1e-3);
  EXPECT_EQ(solution.mesh.intervals(), 20u);
  EXPECT_EQ(solution.options.max_iterations, settings.options.max_iterations);

  PhasedProblem one("one phase");
  one.add(rayleigh_in_least_time());
  const PhasedSolution phased = solve(one, {.grids = {{Mesh::uniform(20), lgr(4)}}});
  EXPECT_TRUE(phased.solved());
  EXPECT_EQ(phased.phases[0].mesh.intervals(), 20u);
  EXPECT_NEAR(phased.phases[0].tf(), solution.tf(), 1e-6);
}

/// Park & Ramirez, AIChE J. 34(9), 1988: a protein secreted by yeast in a fed batch. From straight
/// lines, which have no protein anywhere, the method loses its way on any mesh.
Problem fed_batch() {
  Problem p("fed batch");
  std::vector<Expr> x;
  const double begin[] = {0, 0, 1, 5, 1};
  for (int i = 0; i < 5; ++i) {
    x.push_back(p.state("x" + std::to_string(i + 1)));
    p.initial_bounds(x[i], Bounds::equal(begin[i]));
  }
  const Expr u = p.control("u", {0, 2});
  const Expr growth = 21.87 * x[3] / ((x[3] + 0.4) * (x[3] + 62.5));
  const Expr secretion = 4.75 * growth / (0.12 + growth);
  const Expr expression = x[3] / (0.1 + x[3]) * exp(-5 * x[3]);
  p.dynamics(x[0], secretion * (x[1] - x[0]) - u / x[4] * x[0]);
  p.dynamics(x[1], expression * x[2] - u / x[4] * x[1]);
  p.dynamics(x[2], growth * x[2] - u / x[4] * x[2]);
  p.dynamics(x[3], -7.3 * growth * x[2] + u / x[4] * (20 - x[3]));
  p.dynamics(x[4], u);
  p.final_time(Bounds::equal(15), 15);
  p.mayer("protein", -p.final(x[0]) * p.final(x[4]));
  return p;
}

TEST(HardStarts, WhereCoarseMeshesFailHeldControlsLead) {
  for (const auto& [intervals, scheme] : {std::pair{40, hermite_simpson()}, {20, lgr(4)}}) {
    const Solution solution =
        solve(fed_batch(), {.mesh = Mesh::uniform(intervals), .scheme = scheme});
    EXPECT_TRUE(solution.solved()) << scheme.name << ": " << nlp::to_string(solution.status);
    EXPECT_LT(solution.objective, -31) << "-32.686 in print; there are others nearby";
  }
}

/// From orbit to orbit by two burns, whose coast between says nothing of its ends: a radius of 0,
/// as in a guess of this phase alone, has no finite rate.
PhasedProblem orbit_raise() {
  const auto phase = [](const std::string& name, bool burns, bool first, bool last) {
    Problem p(name);
    const Expr r = p.state("r"), vr = p.state("vr"), vt = p.state("vt"), thrust = p.state("a");
    const Expr spent = p.state("spent");
    const Expr angle = burns ? p.control("angle", {-M_PI / 2, M_PI / 2}) : Expr(0);
    const Expr a = burns ? thrust : Expr(0);
    p.dynamics(r, vr);
    p.dynamics(vr, square(vt) / r - 1 / square(r) + a * sin(angle));
    p.dynamics(vt, -vr * vt / r + a * cos(angle));
    p.dynamics(thrust, burns ? square(thrust) / 1.5 : Expr(0));
    p.dynamics(spent, a);
    const auto fix_all = [&](const std::vector<std::pair<Expr, double>>& values, bool at_end) {
      for (const auto& [state, value] : values) {
        if (at_end)
          p.final_bounds(state, Bounds::equal(value));
        else
          p.initial_bounds(state, Bounds::equal(value));
      }
    };
    if (first) fix_all({{r, 1}, {vr, 0}, {vt, 1}, {thrust, 0.1}, {spent, 0}}, false);
    if (last) fix_all({{r, 3}, {vr, 0}, {vt, std::sqrt(1.0 / 3)}}, true);
    if (last) p.mayer("spent", p.final(spent));
    return p;
  };
  Problem up = phase("up", true, true, false), coast = phase("coast", false, false, false);
  Problem round = phase("round", true, false, true);
  up.final_time({0.5, 10}, 2);
  coast.initial_time({0.5, 10}, 2);
  coast.final_time({1, 60}, 8);
  round.initial_time({1, 60}, 8);
  round.final_time({1.5, 70}, 10);
  PhasedProblem raise("orbit raise");
  for (Problem* each : {&up, &coast, &round}) raise.add(std::move(*each));
  raise.connect(0, 1);
  raise.connect(1, 2);
  return raise;
}

TEST(HardStarts, PhasesBeginWithWhatTheirNeighboursEndsSay) {
  const PhasedSolution solution = solve(orbit_raise());
  EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
  EXPECT_NEAR(solution.objective, 0.3995, 1e-4);  // Dymos 1.13, "Two-burn orbit raise"
}

/// A user's limit on iterations that shows how a solve begins is kept to.
TEST(HardStarts, AShortLimitIsKept) {
  SolveSettings settings{.mesh = Mesh::uniform(20), .scheme = lgr(4)};
  settings.options.max_iterations = 30;
  const Solution solution = solve(rayleigh_in_least_time(), settings);
  EXPECT_EQ(solution.status, nlp::Status::iteration_limit);
  EXPECT_EQ(solution.iterations, 30);
}

}  // namespace
}  // namespace slalom::ocp
