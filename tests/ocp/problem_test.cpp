// Every set-up error: its message says where, what was found and the rule.

#include "slalom/ocp/problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ocp/messages.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// x' = u over one unit of time.
struct Line {
  Problem problem{"line"};
  Expr x = problem.state("x", {-10, 10});
  Expr u = problem.control("u", {-1, 1});
  Line() { problem.dynamics(x, u); }
  void transcribe() { Transcription(problem, Mesh::uniform(3), trapezoidal()); }
  std::string transcription_refusal() {
    return refusal([&] { transcribe(); });
  }
};

TEST(ProblemErrors, Names) {
  Line line;
  const std::string twice = "line: found the name 'x' twice, expected names that differ";
  EXPECT_EQ(refusal([&] { line.problem.state("x"); }), twice);
  EXPECT_EQ(refusal([&] { line.problem.control("x"); }), twice);
  EXPECT_EQ(refusal([&] { line.problem.parameter("x", 1); }), twice);
  EXPECT_EQ(refusal([&] { line.problem.slack("x", End::final, {}); }), twice);
  EXPECT_EQ(refusal([&] { line.problem.static_parameter("x", {}, 0); }), twice);
  // Cost terms have names of their own.
  line.problem.mayer("x", line.x);
  const std::string again = "line: found the cost term 'x' twice, expected names that differ";
  EXPECT_EQ(refusal([&] { line.problem.mayer("x", line.x); }), again);
  EXPECT_EQ(refusal([&] { line.problem.lagrange("x", line.x); }), again);
  EXPECT_EQ(refusal([&] { line.problem.state("t"); }),
            "line: found the name 't', expected another, for it stands for a time in guesses and "
            "answers");
  EXPECT_EQ(refusal([&] { line.problem.path("x", line.x, {}); }), twice);
  EXPECT_EQ(refusal([&] { line.problem.boundary("x", line.x, {}); }), twice);
  EXPECT_EQ(refusal([&] { line.problem.path_family("x", {}, line.x, {}); }), twice);
  for (const char* taken : {"time", "tau", "t0", "tf"})
    EXPECT_NE(refusal([&] { line.problem.state(taken); }), "accepted") << taken;
  EXPECT_EQ(refusal([&] { line.problem.state(""); }), "line: found an empty name, expected a name");
}

TEST(ProblemErrors, Bounds) {
  Line line;
  Problem& p = line.problem;
  const std::string rule = "expected a lower bound not above the upper one";
  EXPECT_EQ(refusal([&] { p.state("a", {2, 1}); }), "line: state a: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.control("b", {2, 1});
            }),
            "line: control b: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.static_parameter("c", {2, 1}, 0);
            }),
            "line: static parameter c: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.slack("d", End::initial, {2, 1});
            }),
            "line: slack d: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.path("e", line.x, {2, 1});
            }),
            "line: path e: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.boundary("f", p.initial(line.x), {2, 1});
            }),
            "line: boundary f: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.path_family("g", {}, line.x, {2, 1});
            }),
            "line: path family g: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] { p.final_time({2, 1}, 1); }), "line: tf: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] { p.initial_time({2, 1}, 1); }), "line: t0: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.initial_bounds(line.x, {2, 1});
            }),
            "line: initial x: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.final_bounds(line.x, {2, 1});
            }),
            "line: final x: found bounds 2 to 1, " + rule);
  EXPECT_EQ(refusal([&] {
              p.state("h", {kNaN, 1});
            }),
            "line: state h: found NaN in its bounds, expected numbers");
  EXPECT_EQ(refusal([&] {
              p.state("i", {kInfinity, kInfinity});
            }),
            "line: state i: found bounds inf to inf, expected bounds that some number satisfies");
}

/// What is corrected is declared under its own name.
TEST(ProblemErrors, WhatIsRefusedIsNotThere) {
  Line line;
  Problem& p = line.problem;
  const auto corrected = [&](const char* name, const auto& declare) {
    EXPECT_NE(refusal([&] { (void)declare(Bounds{2, 1}); }), "accepted") << name;
    EXPECT_EQ(refusal([&] { (void)declare(Bounds{1, 2}); }), "accepted") << name;
  };
  corrected("state", [&](Bounds b) { return p.state("a", b); });
  corrected("initial", [&](Bounds b) { return p.state("b", {}, kAutomaticScale, b); });
  corrected("final", [&](Bounds b) { return p.state("c", {}, kAutomaticScale, {}, b); });
  corrected("control", [&](Bounds b) { return p.control("d", b); });
  corrected("parameter", [&](Bounds b) { return p.static_parameter("e", b, 1); });
  corrected("slack", [&](Bounds b) { return p.slack("f", End::final, b); });
  corrected("integral", [&](Bounds b) { return p.integral("g", line.u, b); });
  corrected("path", [&](Bounds b) { return p.path("h", line.x, b); });
  corrected("path_at", [&](Bounds b) { return p.path_at("i", line.x, Moment::share(.5), b); });
  corrected("boundary", [&](Bounds b) { return p.boundary("j", p.initial(line.x), b); });
  corrected("family", [&](Bounds b) { return p.path_family("k", {}, line.x, b); });
  EXPECT_EQ(p.states().size(), 4u);
  EXPECT_EQ(p.states()[2].initial.lower, 1);
  EXPECT_EQ(p.states()[3].final.upper, 2);
  EXPECT_EQ(p.constraints().size(), 4u);
}

TEST(ProblemErrors, ARefusedChangeLeavesWhatWas) {
  Line line;
  Problem& p = line.problem;
  p.set_scale(line.x, 3);
  p.initial_time({0, 1}, 0.5);
  p.final_time({2, 4}, 3);
  const auto refused = [](const auto& change) { EXPECT_NE(refusal(change), "accepted"); };
  refused([&] { p.set_scale(line.x, -1); });
  refused([&] { p.set_scale(p.final_time(), kNaN); });
  refused([&] { p.initial_time({2, 1}, 0); });
  refused([&] { p.initial_time({0, 2}, kNaN); });
  refused([&] { p.final_time({9, 8}, 8); });
  EXPECT_EQ(p.states()[0].scale, 3);
  EXPECT_FALSE(p.tf().scaled());
  for (const auto* time : {&p.t0(), &p.tf()}) {
    const bool first = time == &p.t0();
    EXPECT_EQ(time->bounds.lower, first ? 0 : 2);
    EXPECT_EQ(time->bounds.upper, first ? 1 : 4);
    EXPECT_EQ(time->guess, first ? 0.5 : 3);
  }
}

TEST(ProblemErrors, BoundsThatDoNotMeet) {
  Line line;
  line.problem.initial_bounds(line.x, Bounds::equal(11));
  EXPECT_EQ(
      line.transcription_refusal(),
      "line: initial x: found bounds 11 to 10 at an end and over the horizon, expected bounds "
      "that meet");
}

TEST(ProblemErrors, ScaleAndGuess) {
  Line line;
  EXPECT_EQ(refusal([&] { line.problem.state("a", {}, -2); }),
            "line: state a: found scale -2, expected a scale > 0");
  EXPECT_EQ(refusal([&] { line.problem.state("b", {}, kNaN); }),
            "line: state b: found scale nan, expected a scale > 0");
  EXPECT_EQ(refusal([&] { line.problem.static_parameter("c", {}, kNaN); }),
            "line: static parameter c: found guess nan, expected a finite guess");
  EXPECT_EQ(refusal([&] {
              line.problem.final_time({1, 2}, kInfinity);
            }),
            "line: tf: found guess inf, expected a finite guess");
}

TEST(ProblemErrors, ParametersAreFinite) {
  Line line;
  const std::string rule = "line: parameter a: found nan, expected a finite number";
  EXPECT_EQ(refusal([&] { line.problem.parameter("a", kNaN); }), rule);
  const Expr a = line.problem.parameter("a", 1);
  EXPECT_EQ(refusal([&] { line.problem.set_parameter(a, kNaN); }), rule);
  EXPECT_EQ(refusal([&] { line.problem.set_parameter(line.x, 1); }),
            "line: found set_parameter of something else, expected a parameter of this problem");
}

TEST(ProblemErrors, States) {
  Problem empty("empty");
  EXPECT_EQ(refusal([&] { Transcription(empty, Mesh::uniform(2), trapezoidal()); }),
            "empty: found no states, expected at least one state");
  Line line;
  Expr y = line.problem.state("y");
  EXPECT_EQ(line.transcription_refusal(),
            "line: state y: found no dynamics, expected a call of dynamics for each state");
  EXPECT_EQ(refusal([&] { line.problem.dynamics(line.x, line.u); }),
            "line: dynamics: found a second rate of x, expected one for each state");
  EXPECT_EQ(refusal([&] { line.problem.dynamics(line.u, line.u); }),
            "line: dynamics: found 'u', expected a state of this problem");
  EXPECT_EQ(refusal([&] { (void)line.problem.initial(2 * line.x); }),
            "line: initial: found an expression, expected a state of this problem");
  EXPECT_EQ(refusal([&] { (void)line.problem.final(line.u); }),
            "line: final: found 'u', expected a state of this problem");
}

TEST(ProblemErrors, ForeignSymbols) {
  Line line;
  line.problem.path("wall", line.x + Expr::symbol("z"), {0, 1});
  EXPECT_EQ(line.transcription_refusal(),
            "line: wall: found the symbol 'z', expected symbols made by this problem only");
  Line other;
  other.problem.lagrange("effort", square(line.u));  // a symbol of another problem, same name
  EXPECT_EQ(other.transcription_refusal(),
            "line: effort: found the symbol 'u', expected symbols made by this problem only");
}

TEST(ProblemErrors, BoundaryFunctionsUseEndValuesOnly) {
  const std::string rule = "expected end values only: initial(x), final(x), t0, tf, parameters";
  Line line;
  line.problem.mayer("cost", line.x);
  EXPECT_EQ(line.transcription_refusal(), "line: cost: found 'x', " + rule);
  Line control;
  control.problem.boundary("end", control.u, Bounds::equal(0));
  EXPECT_EQ(control.transcription_refusal(), "line: end: found 'u', " + rule);
  Line time;
  time.problem.boundary("end", time.problem.time(), Bounds::equal(0));
  EXPECT_EQ(time.transcription_refusal(), "line: end: found 'time', " + rule);
}

TEST(ProblemErrors, SlacksStayAtTheirEnd) {
  const std::string rule =
      "line: found slack 's' away from its end, expected slacks in boundary rows and Mayer terms "
      "of "
      "their own end only";
  Line path;
  const Expr s = path.problem.slack("s", End::initial, {});
  path.problem.path("wall", path.x + s, {0, 1});
  EXPECT_EQ(path.transcription_refusal(), rule);
  Line ends;
  const Expr t = ends.problem.slack("s", End::initial, {});
  ends.problem.boundary("end", ends.problem.final(ends.x) + t, {0, 1});
  EXPECT_EQ(ends.transcription_refusal(), rule);
}

TEST(ProblemErrors, Families) {
  Line line;
  Problem& p = line.problem;
  const Expr a = Expr::symbol("a"), b = Expr::symbol("b");
  const auto family = p.path_family("wall", {a, b}, line.x - a * b, {0, 1});
  const auto single = p.path("single", line.x, {0, 1});
  const std::string where = "line: family wall: ";
  EXPECT_EQ(refusal([&] {
              p.set_members(family, {"one"}, {{1, 2}, {3, 4}});
            }),
            where + "found 1 names, 2 members, expected one name a member");
  EXPECT_EQ(refusal([&] {
              p.set_members(family, {"one"}, {{1, 2, 3}});
            }),
            where +
                "found a member with 3 numbers, expected 2, one for each symbol, or so many for "
                "each point");
  EXPECT_EQ(refusal([&] {
              p.set_members(family, {"one"}, {{1, kNaN}});
            }),
            where + "found a member with NaN or infinity, expected finite numbers");
  EXPECT_EQ(refusal([&] { p.set_members(single, {"one"}, {{1}}); }),
            "line: family single: found a single constraint, expected a family");
  EXPECT_EQ(refusal([&] { p.enable({7}, true); }),
            "line: found constraint 7, expected one of the 2 constraints");

  p.set_members(family, {"one", "two"}, {{1, 2}, {3, 4}});
  Transcription transcription(p, Mesh::uniform(3), trapezoidal());
  p.set_members(family, {"one"}, {{1, 2}});
  EXPECT_EQ(refusal([&] { transcription.update(p); }),
            where +
                "found 1 members, expected as many as were transcribed; another number needs a new "
                "transcription");
}

TEST(ProblemErrors, UpdateWithAnotherProblem) {
  Line line;
  const auto wall = line.problem.path("wall", line.x, {0, 1});
  line.problem.lagrange("effort", square(line.u));
  Transcription transcription(line.problem, Mesh::uniform(3), trapezoidal());
  Line other;
  EXPECT_NE(refusal([&] { transcription.update(other.problem); }), "accepted");
  Problem switched = line.problem;
  switched.enable(wall, false);
  EXPECT_EQ(refusal([&] { transcription.update(switched); }),
            "line: found wall switched, expected the constraints and cost terms that were "
            "transcribed; another choice needs a new transcription");
  switched = line.problem;
  switched.enable_cost("effort", false);
  EXPECT_NE(refusal([&] { transcription.update(switched); }).find("effort"), std::string::npos);
}

TEST(ProblemErrors, UnknownNamesComeWithTheNearest) {
  Line line;
  line.problem.lagrange("effort", square(line.u));
  EXPECT_EQ(refusal([&] { line.problem.enable_cost("efort", false); }),
            "line: found no cost term 'efort', expected perhaps 'effort'");
  const Solution solution = solve(line.problem);
  EXPECT_EQ(solution.state("x").size(), solution.time().size());
  EXPECT_EQ(refusal([&] { (void)solution.state("xx"); }),
            "solution: found no state 'xx', expected perhaps 'x'");
  EXPECT_EQ(refusal([&] { (void)solution.cost_term("effrt"); }),
            "solution: found no cost term 'effrt', expected perhaps 'effort'");
  EXPECT_NE(refusal([&] { (void)solution.control("thrust"); }).find("one of u"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)solution.slack("s"); }).find("a problem with one"),
            std::string::npos);
}

TEST(ProblemErrors, GuessOfAnotherShape) {
  Line line;
  Transcription transcription(line.problem, Mesh::uniform(3), trapezoidal());
  Trajectory guess = transcription.straight_guess();
  EXPECT_EQ(transcription.point(guess).size(), transcription.structure().variables);
  Trajectory bad = guess;
  bad.states.pop_back();
  EXPECT_EQ(refusal([&] { (void)transcription.point(bad); }),
            "line: guess: found 1 points of states, expected 2, one for each tau");
  bad = guess;
  bad.controls[1].clear();
  EXPECT_EQ(refusal([&] { (void)transcription.point(bad); }),
            "line: guess: found 0 controls at point 1, expected 1");
  bad = guess;
  bad.tau = {};
  EXPECT_NE(refusal([&] { (void)transcription.point(bad); }), "accepted");
}

}  // namespace
}  // namespace slalom::ocp
