// What no declaration alone shows: refused when a problem is transcribed, or ended by the solve
// with a status that names the function or the constraint. Declarations are in problem_test.cpp.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "ocp/messages.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/ocp.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// x' = u over one unit of time, least effort.
struct Line {
  Problem problem{"line"};
  Expr x = problem.state("x", {-10, 10}), u = problem.control("u", {-1, 1});
  Line() {
    problem.dynamics(x, u);
    problem.lagrange("effort", square(u));
  }
};

using Change = std::function<void(Line&)>;

struct Refused {
  const char* name;
  Change change;
  std::string message;
};

const std::string kNoVariable =
    ": found a function of no variable, expected one that some variable can change";

const std::vector<Refused>& refused() {
  static const std::vector<Refused> table = {
      {"tf before t0",
       [](Line& l) {
         l.problem.initial_time(Bounds::equal(1), 1);
         l.problem.final_time({0, 0.5}, 0.5);
       },
       "line: tf: found bounds 0 to 0.5, t0 from 1 to 1, expected bounds with some tf >= t0"},
      {"tf negative", [](Line& l) { l.problem.final_time(Bounds::equal(-1), -1); },
       "line: tf: found bounds -1 to -1, t0 from 0 to 0, expected bounds with some tf >= t0"},
      {"path of a constant",
       [](Line& l) {
         l.problem.path("c", 2.5, {2, 3});
       },
       "line: c at node 0" + kNoVariable},
      {"path of what cancels", [](Line& l) { l.problem.path("c", l.x - l.x, Bounds::equal(0)); },
       "line: c at node 0" + kNoVariable},
      {"path of a parameter",
       [](Line& l) {
         l.problem.path("c", l.problem.parameter("a", 1), {0, 3});
       },
       "line: c at node 0" + kNoVariable},
      {"path of a time that is fixed",
       [](Line& l) {
         l.problem.path("c", sin(l.problem.time()), {-1, 1});
       },
       "line: c at node 0" + kNoVariable},
      {"boundary of a constant", [](Line& l) { l.problem.boundary("c", 1, Bounds::equal(1)); },
       "line: c" + kNoVariable},
      {"member of nothing but its numbers",
       [](Line& l) {
         const Expr a = Expr::symbol("a");
         const auto family = l.problem.path_family("f", {a}, a, {0, 2});
         l.problem.set_members(family, {"one"}, {{1}});
       },
       "line: f[one] at node 0" + kNoVariable},
      {"path without bounds", [](Line& l) { l.problem.path("c", l.x, {}); },
       "line: path c: found no bounds, expected a lower or upper bound, or a number that it "
       "equals"},
      {"boundary without bounds",
       [](Line& l) { l.problem.boundary("c", l.problem.final(l.x), {}); },
       "line: boundary c: found no bounds, expected a lower or upper bound, or a number that it "
       "equals"},
  };
  return table;
}

TEST(BadInput, IsRefusedWhenTranscribed) {
  for (const auto& each : refused()) {
    const auto message = refusal([&] {
      Line line;
      each.change(line);
      (void)solve(line.problem, {.mesh = Mesh::uniform(10), .scheme = trapezoidal()});
    });
    EXPECT_EQ(message, each.message) << each.name;
  }
}

TEST(BadInput, AnUpdateIsRefusedLikewise) {
  Line line;
  line.problem.final_time({0.5, 2}, 1);
  Transcription transcription(line.problem, Mesh::uniform(3), trapezoidal());
  line.problem.final_time({-2, -1}, -1);
  EXPECT_EQ(refusal([&] { transcription.update(line.problem); }),
            "line: tf: found bounds -2 to -1, t0 from 0 to 0, expected bounds with some tf >= t0");
}

TEST(BadInput, FunctionsOfAFreeTimeOrOfAnEndAreNone) {
  Line line;
  line.problem.final_time({0.5, 3}, 1);
  line.problem.path("clock", line.problem.time(), Bounds::at_most(2));
  line.problem.boundary("end", line.problem.final(line.x), {0.2, 1});
  EXPECT_TRUE(solve(line.problem).solved());
}

struct Ended {
  const char* name;
  Change change;
  nlp::Status status;
  std::string function, where, variable;  ///< of the fault
  std::string constraint;                 ///< the worst one's begin
};

const std::vector<Ended>& ended() {
  using nlp::Status;
  static const std::vector<Ended> table = {
      {"NaN in a cost", [](Line& l) { l.problem.lagrange("c", l.x * kNaN); },
       Status::invalid_number, "c", "node 0", "", ""},
      {"NaN in a path row",
       [](Line& l) {
         l.problem.path("c", l.x + kNaN, {0, 1});
       },
       Status::invalid_number, "c", "node 0", "", ""},
      {"infinity in the dynamics",
       [](Line& l) { l.problem.dynamics(l.problem.state("y"), l.x * kInfinity); },
       Status::invalid_number, "dynamics of y", "node 0", "", ""},
      {"logarithm outside its domain", [](Line& l) { l.problem.lagrange("c", log(l.x - 20)); },
       Status::invalid_number, "c", "node 0", "", ""},
      {"derivative of sqrt at 0",
       [](Line& l) {
         l.problem.fix(l.x, 0, 0.5);
         l.problem.lagrange("c", sqrt(l.x));
       },
       Status::invalid_number, "c", "node 0", "x", ""},
      {"end out of reach", [](Line& l) { l.problem.fix(l.x, 0, 5); }, Status::infeasible, "", "",
       "", "defect"},
      {"boundary row out of reach",
       [](Line& l) {
         l.problem.fix(l.x, 0, 0.5);
         l.problem.boundary("leap", l.problem.final(l.x) - l.problem.initial(l.x),
                            Bounds::equal(4));
       },
       Status::infeasible, "", "", "", "leap"},
      {"integral out of reach",
       [](Line& l) {
         l.problem.fix(l.x, 0, 0.5);
         l.problem.integral("area", l.x, Bounds::equal(9));
       },
       Status::infeasible, "", "", "", "integral area"},
      {"path row against the start",
       [](Line& l) {
         l.problem.fix(l.x, 0, 0.5);
         l.problem.path("wall", l.x, Bounds::at_least(0.1));
       },
       Status::infeasible, "", "", "", "wall at node 0"},
      {"rows against each other",
       [](Line& l) {
         l.problem.boundary("a", l.problem.initial(l.x), Bounds::equal(0));
         l.problem.boundary("b", l.problem.initial(l.x), Bounds::equal(1));
       },
       Status::infeasible, "", "", "", "a"},
      {"more equations than unknowns",
       [](Line& l) {
         l.problem.initial_bounds(l.x, Bounds::equal(1));
         l.problem.path("a", l.u - l.x, Bounds::equal(0));
         l.problem.path("b", l.u - 2 * l.x, Bounds::equal(0));
       },
       Status::too_few_freedoms, "", "", "", ""},
      {"nothing that holds a control",
       [](Line& l) { l.problem.lagrange("c", l.problem.control("w")); }, Status::unbounded, "", "",
       "", ""},
  };
  return table;
}

TEST(BadInput, EndsASolveWithAStatusThatNamesIt) {
  for (const auto& each : ended()) {
    SCOPED_TRACE(each.name);
    Line line;
    each.change(line);
    const Solution solution = solve(line.problem, {.mesh = Mesh::uniform(10)});
    EXPECT_EQ(solution.status, each.status) << nlp::to_string(solution.status);
    EXPECT_FALSE(solution.solved());
    EXPECT_EQ(solution.fault.function, each.function);
    EXPECT_EQ(solution.fault.where, each.where);
    EXPECT_EQ(solution.fault.variable, each.variable);
    EXPECT_EQ(solution.residuals.worst_constraint.find(each.constraint), 0u)
        << solution.residuals.worst_constraint;
    if (!each.constraint.empty()) EXPECT_GT(solution.residuals.violation, 1e-3);
  }
}

TEST(BadInput, OfLinks) {
  PhasedProblem both("both");
  EXPECT_EQ(refusal([&] { both.link("l", 1); }),
            "both: link l: found a function of no variable, expected one of end values, times, "
            "static parameters or integrals");
  EXPECT_EQ(refusal([&] {
              both.link("l", Expr::symbol("s"), {kNaN, 1});
            }),
            "both: link l: found NaN in its bounds, expected numbers");
}

// --- kinks: what docs/ocp.md says of them ----------------------------------------------------

/// The derivative by x at a point, of an expression of x alone.
double slope(const std::function<Expr(const Expr&)>& f, double at) {
  const Expr x = Expr::symbol("x");
  const expr::Function function({x}, {}, {f(x)});
  double value = 0;
  std::vector<double> jacobian(function.jacobian_pattern().size());
  function.evaluate(1, {&at, 1}, {}, {}, {.jacobian = true}, {&value, 1}, jacobian, {});
  return jacobian.empty() ? 0 : jacobian.front();
}

TEST(Kinks, HaveTheDerivativesThatAreDocumented) {
  EXPECT_EQ(slope([](const Expr& x) { return abs(x); }, 0), 0);
  EXPECT_EQ(slope([](const Expr& x) { return sign(x); }, 0), 0);
  EXPECT_EQ(slope([](const Expr& x) { return min(2 * x, 3 * x); }, 0), 3);
  EXPECT_EQ(slope([](const Expr& x) { return max(2 * x, 3 * x); }, 0), 3);
  EXPECT_EQ(slope([](const Expr& x) { return max(x, 0.0); }, 0), 0);
  EXPECT_EQ(slope([](const Expr& x) { return max(0.0, x); }, 0), 1);
  EXPECT_EQ(slope([](const Expr& x) { return select(x, 2 * x, 3 * x); }, 0), 3);
  EXPECT_EQ(slope([](const Expr& x) { return sqrt(x); }, 0), kInfinity);
  EXPECT_EQ(slope([](const Expr& x) { return select(x, sqrt(x), 0.0); }, 0), 0);
}

/// Least effort and least |x| on the way from -1/4 to 1/4, as smooth rows: a >= x, a >= -x.
TEST(Kinks, OfAbsAreSmoothAsTwoRows) {
  Line line;
  line.problem.fix(line.x, -0.25, 0.25);
  const Expr a = line.problem.control("a");
  line.problem.path("above", a - line.x, Bounds::at_least(0));
  line.problem.path("below", a + line.x, Bounds::at_least(0));
  line.problem.lagrange("distance", a);
  const Solution rows = solve(line.problem);
  EXPECT_TRUE(rows.solved());
  Line kinked;  // x = 0 at the middle node
  kinked.problem.fix(kinked.x, -0.25, 0.25);
  kinked.problem.lagrange("distance", abs(kinked.x));
  EXPECT_FALSE(solve(kinked.problem, {.options = {.max_iterations = 50}}).solved());
  // The same rounded off by 1e-3.
  Line round;
  round.problem.fix(round.x, -0.25, 0.25);
  round.problem.lagrange("distance", sqrt(square(round.x) + 1e-6));
  const Solution rounded = solve(round.problem);
  EXPECT_TRUE(rounded.solved()) << nlp::to_string(rounded.status);
  EXPECT_NEAR(rounded.objective, rows.objective, 1e-3);
}

}  // namespace
}  // namespace slalom::ocp
