#include "slalom/ocp/values.hpp"

#include <gtest/gtest.h>

#include "ocp/messages.hpp"
#include "slalom/ocp/phases.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

struct Line {
  Problem problem{"line"};
  Expr x = problem.state("x"), u = problem.control("u"), k = problem.parameter("k", 3);

  Line() {
    problem.dynamics(x, u);
    problem.fix(x, 0, 2);
    problem.lagrange("effort", square(u));
    problem.final_time(Bounds::equal(4), 4);
  }
};

TEST(Values, AreAnExpressionAlongAnAnswer) {
  Line line;
  const Solution s = solve(line.problem, {.mesh = Mesh::uniform(5)});
  const Expr e =
      line.k * line.x + square(line.u) * line.problem.time() + line.problem.final(line.x);
  const auto list = values(line.problem, s, e);
  ASSERT_EQ(list.size(), s.trajectory.tau.size());
  for (std::size_t p = 0; p < list.size(); ++p) {
    const double t = s.time()[p];
    EXPECT_NEAR(list[p], 3 * t / 2 + t / 4 + 2, 1e-6);
  }
  EXPECT_NEAR(values(line.problem, s, e, {1.3}).front(), 3 * 0.65 + 1.3 / 4 + 2, 1e-6);
  EXPECT_TRUE(changes_over_time(line.problem, e));
  EXPECT_FALSE(changes_over_time(line.problem, line.k * line.problem.final(line.x)));
}

TEST(Values, OfAForeignSymbolAreRefused) {
  Line line;
  const Solution s = solve(line.problem, {.mesh = Mesh::uniform(5)});
  const auto message =
      refusal([&] { (void)values(line.problem, s, line.x + Expr::symbol("foreign")); });
  EXPECT_NE(message.find("foreign"), std::string::npos) << message;
}

TEST(Gaps, OfConnectedPhasesAreLeftAloneOrJumps) {
  PhasedProblem both("both");
  for (const char* name : {"one", "two"}) {
    Problem p(name);
    const Expr x = p.state("x"), m = p.state("m"), u = p.control("u");
    p.dynamics(x, u);
    p.dynamics(m, -1);
    p.lagrange("effort", square(u));
    if (name[0] == 'o') {
      p.fix(x, 0, 0.5);
      p.initial_bounds(m, Bounds::equal(10));
    } else {
      p.initial_time(Bounds::equal(1), 1);
      p.final_time(Bounds::equal(2), 2);
      p.final_bounds(x, Bounds::equal(3));
    }
    both.add(p);
  }
  EXPECT_EQ(
      refusal([&] { both.connect(0, 1, {.without = {"y"}}); }),
      "both: connect: found no state 'y' of both one and two, expected states that both have");
  EXPECT_EQ(refusal([&] { both.connect(0, 1, {.jumps = {{"n", -4}}}); }).find("both: connect"), 0U);
  EXPECT_TRUE(both.links().empty()) << "refused as a whole";
  both.connect(0, 1, {.without = {"x"}, .jumps = {{"m", -4}}});
  const PhasedSolution s = solve(both);
  ASSERT_TRUE(s.solved());
  EXPECT_NEAR(s.phases[1].state("m").front(), s.phases[0].state("m").back() - 4, 1e-8);
  EXPECT_NEAR(s.phases[1].state("x").front(), 3, 1e-6) << "is free to jump";
}

}  // namespace
}  // namespace slalom::ocp
