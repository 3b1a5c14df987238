// What an infeasible problem names: what stands against each other, and by how much.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/refine.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

/// x' = u from 0 to `way` in one time unit, |u| <= `most`.
Problem line(const std::string& name, double way, double most = 1) {
  Problem p(name);
  const Expr x = p.state("x"), u = p.control("u", {-most, most});
  p.dynamics(x, u);
  p.fix(x, 0, way);
  p.lagrange("effort", square(u));
  return p;
}

/// By how much a bound would have to move; 0 where it is not named.
double change_of(const std::vector<Conflict>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const Conflict& each) { return each.name == name; });
  return found == list.end() ? 0 : found->change;
}

TEST(Conflicts, NameBoundsAndEndsAndByHowMuchEachWouldHaveToMove) {
  for (const Scheme& scheme : {hermite_simpson(), lgr(3), trapezoidal()}) {
    SCOPED_TRACE(scheme.name);
    const Solution solution = solve(line("line", 5), {.mesh = Mesh::uniform(10), .scheme = scheme});
    ASSERT_EQ(solution.status, nlp::Status::infeasible);
    EXPECT_NEAR(change_of(solution.conflicts, "final x"), -4, 0.01);
    EXPECT_NEAR(change_of(solution.conflicts, "initial x"), 4, 0.01);
    EXPECT_NEAR(change_of(solution.conflicts, "u"), 4, 0.01);
  }
}

TEST(Conflicts, LeaveOutWhatIsNoPartOfIt) {
  Problem p = line("line", 0.5, 50);  // fast enough to be beyond the wall at the end alone
  const Expr x = p.states()[0].symbol;
  p.path("wall", x, Bounds::at_most(0.3));
  p.path("far", x, Bounds::at_most(7));
  const Solution solution = solve(p, {.mesh = Mesh::uniform(10)});
  ASSERT_EQ(solution.status, nlp::Status::infeasible);
  EXPECT_NEAR(change_of(solution.conflicts, "wall"), 0.2, 1e-3);
  EXPECT_NEAR(change_of(solution.conflicts, "final x"), -0.2, 1e-3);
  EXPECT_EQ(change_of(solution.conflicts, "far"), 0);
  EXPECT_EQ(change_of(solution.conflicts, "u"), 0);
}

TEST(Conflicts, OfPhasesAreNamedWithThem) {
  PhasedProblem both("both");
  Problem one("one"), two = line("two", 0);
  one.dynamics(one.state("x"), one.control("u", {-1, 1}));
  one.initial_bounds(one.states()[0].symbol, Bounds::equal(0));
  two.initial_time(Bounds::equal(1), 1);
  two.final_time(Bounds::equal(2), 2);
  two.initial_bounds(two.states()[0].symbol, {});
  two.final_bounds(two.states()[0].symbol, Bounds::equal(5));
  both.add(one);
  both.add(two);
  both.connect(0, 1);
  const PhasedSolution solution = solve(both);
  ASSERT_EQ(solution.status, nlp::Status::infeasible);
  EXPECT_NEAR(change_of(solution.conflicts, "two: final x"), -3, 0.01);
  EXPECT_NEAR(change_of(solution.conflicts, "one: u"), 3, 0.01);
  EXPECT_NEAR(std::abs(change_of(solution.conflicts, "x from one to two")), 3, 0.01);
}

TEST(Conflicts, AreNoneOfASolution) {
  EXPECT_TRUE(solve(line("line", 0.5)).conflicts.empty());
}

// --- equations that no freedom meets ---------------------------------------------------------

TEST(DependentRows, AreSolvedWhereTheyHold) {
  for (const Scheme& scheme : {hermite_simpson(), lgr(3), backward_euler(), lgl(4)}) {
    SCOPED_TRACE(scheme.name);
    Problem twice = line("twice", 0.5);
    const Expr x = twice.states()[0].symbol, u = twice.controls()[0].symbol;
    const Expr y = twice.control("y");
    twice.path("a", y - u - x, Bounds::equal(0));
    twice.path("b", 2 * y - 2 * u - 2 * x, Bounds::equal(0));
    const Solution solution = solve(twice, {.scheme = scheme});
    EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
    EXPECT_NEAR(solution.objective, 0.25, 1e-6);

    Problem given("given");  // a control that its bounds give
    const Expr z = given.state("z"), w = given.control("w"), c = given.control("c", {0.5, 0.5});
    given.dynamics(z, c + w);
    given.initial_bounds(z, Bounds::equal(0));
    given.lagrange("effort", square(w) + square(z));
    const Solution other = solve(given, {.scheme = scheme});
    EXPECT_TRUE(other.solved()) << nlp::to_string(other.status);
    EXPECT_NEAR(other.objective, 0.0596, scheme.order > 1 ? 1e-4 : 3e-3);
  }
}

/// x' = -k x, measured at four times: phases between them, whose times are given.
TEST(DependentRows, LinksOfFixedTimesAskForNothing) {
  PhasedProblem fit("fit");
  std::vector<Expr> rates;
  for (int i = 0; i < 4; ++i) {
    Problem p(std::to_string(i));
    const Expr x = p.state("x"), k = p.static_parameter("k", {0, 5}, 1);
    if (i == 0) p.initial_bounds(x, Bounds::equal(1));
    p.dynamics(x, -k * x);
    p.initial_time(Bounds::equal(i / 4.0), 0);
    p.final_time(Bounds::equal((i + 1) / 4.0), 1);
    p.mayer("misfit", square(p.final(x) - std::exp(-1.3 * (i + 1) / 4.0)));
    fit.add(p);
    rates.push_back(k);
    if (i == 0) continue;
    fit.connect(static_cast<std::size_t>(i - 1), static_cast<std::size_t>(i));
    fit.link("k " + p.name(), k - rates[rates.size() - 2]);
  }
  PhasedSettings settings;
  settings.grids.assign(4, {Mesh::uniform(4), hermite_simpson()});
  const PhasedSolution solution = solve(fit, settings);
  EXPECT_TRUE(solution.solved()) << nlp::to_string(solution.status);
  EXPECT_NEAR(solution.phases[0].static_parameter("k"), 1.3, 1e-6);

  fit.link("apart", rates[0] - rates[0] + fit.phases()[0].final_time() -
                        fit.phases()[2].initial_time());  // 0.25 and 0.5: does not hold
  EXPECT_NE(solve(fit, settings).status, nlp::Status::solved);
}

TEST(DependentRows, ThatContradictEachOtherAreNamed) {
  Problem p = line("line", 0.5);
  const Expr x = p.states()[0].symbol, u = p.controls()[0].symbol;
  p.path("a", u - x, Bounds::equal(0));
  p.path("b", u - 2 * x, Bounds::equal(0));
  const Solution solution = solve(p, {.mesh = Mesh::uniform(10)});
  EXPECT_EQ(solution.status, nlp::Status::too_few_freedoms);
  EXPECT_NE(change_of(solution.conflicts, "a"), 0);
  EXPECT_NE(change_of(solution.conflicts, "b"), 0);
}

/// A norm that the dynamics keep, but the discretised ones only nearly: held along the horizon it
/// leaves no freedom.
TEST(DependentRows, ThatDynamicsAllButKeepAreNamed) {
  Problem p("norm");
  const Expr a = p.state("a"), b = p.state("b"), w = p.control("w", {-3, 3});
  p.dynamics(a, -w * b);
  p.dynamics(b, w * a);
  p.initial_bounds(a, Bounds::equal(1));
  p.fix(b, 0, 1);
  p.path("norm", square(a) + square(b), Bounds::equal(1));
  p.lagrange("effort", square(w));
  const Solution solution = solve(p, {.scheme = lgr(4)});
  EXPECT_EQ(solution.status, nlp::Status::too_few_freedoms) << nlp::to_string(solution.status);
  ASSERT_FALSE(solution.conflicts.empty());
  EXPECT_EQ(solution.conflicts.front().name, "norm");
}

/// A pendulum in Cartesian coordinates: its length is met by the tension in the second derivative.
Problem pendulum(bool by_acceleration) {
  Problem p("pendulum");
  const Expr x = p.state("x"), y = p.state("y"), vx = p.state("vx"), vy = p.state("vy");
  const Expr tension = p.control("tension"), push = p.control("push", {-5, 5});
  p.dynamics(x, vx);
  p.dynamics(y, vy);
  p.dynamics(vx, -tension * x + push);
  p.dynamics(vy, -tension * y - 9.81);
  p.initial_bounds(x, Bounds::equal(0));
  p.initial_bounds(y, Bounds::equal(-1));
  p.initial_bounds(vx, Bounds::equal(0));
  p.initial_bounds(vy, Bounds::equal(0));
  p.final_bounds(x, Bounds::equal(0.5));
  p.lagrange("effort", square(push));
  if (by_acceleration)
    p.path("length",
           square(vx) + square(vy) + x * push - tension * (square(x) + square(y)) - 9.81 * y,
           Bounds::equal(0));
  else
    p.path("length", square(x) + square(y), Bounds::equal(1));
  return p;
}

TEST(HighIndex, IsSaidOfWhatIsNotSolvedByIt) {
  nlp::Options few;
  few.max_iterations = 5;
  const Solution solution = solve(pendulum(false), {.options = few});
  ASSERT_FALSE(solution.solved());
  ASSERT_EQ(solution.high_index.size(), 1u);
  EXPECT_EQ(solution.high_index[0].name, "length");
  EXPECT_EQ(solution.high_index[0].index, 3);
  // Stated as it advises, the same motion is found, and nothing is said.
  const Solution stated = solve(pendulum(true));
  ASSERT_TRUE(stated.solved()) << stated.residuals.worst_constraint;
  EXPECT_TRUE(stated.high_index.empty());
  const auto& end = stated.trajectory.states.back();
  EXPECT_NEAR(end[0] * end[0] + end[1] * end[1], 1, 1e-4);
  EXPECT_TRUE(solve(pendulum(true), {.options = few}).high_index.empty());
}

TEST(HighIndex, IsSaidOfWhatNoMeshRefines) {
  const RefineRules rules{.max_meshes = 2};
  const Refined refined = refine(pendulum(false), {.mesh = Mesh::uniform(10)}, rules);
  EXPECT_NE(refined.status, RefineStatus::converged);
  ASSERT_EQ(refined.solution.high_index.size(), 1u);
  EXPECT_EQ(refined.solution.high_index[0].name, "length");

  PhasedProblem one("one phase");
  one.add(pendulum(false));
  const PhasedRefined phased =
      refine(one, {.grids = {{Mesh::uniform(10), hermite_simpson()}}}, rules);
  EXPECT_NE(phased.status, RefineStatus::converged);
  EXPECT_EQ(phased.solution.phases.at(0).high_index.size(), 1u);
}

TEST(HighIndex, IsNotSaidOfPhasesThatAreSolved) {
  Problem p("follower");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u");
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.path("follow", x - sin(p.time()), Bounds::equal(0));
  p.lagrange("effort", square(u));
  PhasedProblem one("one phase");
  one.add(p);
  const PhasedSolution solution = solve(one, {.grids = {{Mesh::uniform(10), backward_euler()}}});
  ASSERT_TRUE(solution.solved()) << solution.residuals.worst_constraint;
  EXPECT_TRUE(solution.phases.at(0).high_index.empty());
}

}  // namespace
}  // namespace slalom::ocp
