// Periodic orbits that cost nothing, of a period that is free: rows of both ends depend on each
// other, and multipliers are rounding.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/refine.hpp"

namespace slalom::ocp {
namespace {

struct Oscillator {
  Problem problem;
  Expr x, v;
};

/// One that keeps its energy.
Oscillator pendulum(const std::string& name) {
  Problem p(name);
  const Expr x = p.state("x"), v = p.state("v");
  p.dynamics(x, v);
  p.dynamics(v, -sin(x));
  return {p, x, v};
}

/// One with a limit cycle.
Oscillator van_der_pol() {
  Problem p("van der Pol");
  const Expr x = p.state("x"), v = p.state("v");
  p.dynamics(x, v);
  p.dynamics(v, (1 - square(x)) * v - x);
  p.initial_bounds(v, Bounds::equal(0));
  return {p, x, v};
}

void close(Oscillator& of) {
  of.problem.boundary("x again", of.problem.final(of.x) - of.problem.initial(of.x),
                      Bounds::equal(0));
  of.problem.boundary("v again", of.problem.final(of.v) - of.problem.initial(of.v),
                      Bounds::equal(0));
}

void expect_period(const Refined& refined, double period) {
  SCOPED_TRACE(refined.table());
  EXPECT_EQ(refined.status, RefineStatus::converged);
  EXPECT_NEAR(refined.solution.tf() / period, 1, 2e-6);
  EXPECT_LE(refined.errors.largest, 1e-6);
  EXPECT_EQ(refined.meshes.back().objective_error, 0) << "0, whatever the states are";
  EXPECT_EQ(refined.errors.objective, 0);
}

const std::vector<Scheme>& schemes() {
  static const std::vector<Scheme> list{hermite_simpson(), lgr(4)};
  return list;
}

/// Of four rows for the ends and a free time one follows from the others, but on a mesh that is not
/// its own mirror image its scheme's errors leave no point that meets all.
TEST(PeriodicOrbit, OfAPendulumGivenAtItsStart) {
  for (const double amplitude : {1.0, 2.5})
    for (const Scheme& scheme : schemes()) {
      SCOPED_TRACE(scheme.name + " from " + std::to_string(amplitude));
      Oscillator of = pendulum("pendulum");
      of.problem.initial_bounds(of.x, Bounds::equal(amplitude));
      of.problem.initial_bounds(of.v, Bounds::equal(0));
      close(of);
      const double about = amplitude > 2 ? 9 : 6.5;
      of.problem.final_time({5, 20}, about);
      const Trajectory guess = Guess(of.problem)
                                   .times(0, about)
                                   .simulated({amplitude, 0}, constant_controls({}))
                                   .trajectory();
      expect_period(refine(of.problem, {.scheme = scheme, .guess = guess}),
                    4 * std::comp_ellint_1(std::sin(amplitude / 2)));
    }
}

/// By its energy, and without the row that follows from the others.
TEST(PeriodicOrbit, OfAPendulumOfGivenEnergy) {
  for (const Scheme& scheme : schemes()) {
    SCOPED_TRACE(scheme.name);
    Oscillator of = pendulum("pendulum");
    Problem& p = of.problem;
    p.initial_bounds(of.v, Bounds::equal(0));
    p.boundary("energy", square(p.initial(of.v)) / 2 - cos(p.initial(of.x)), Bounds::equal(0));
    p.boundary("v again", p.final(of.v) - p.initial(of.v), Bounds::equal(0));
    p.final_time({5, 12}, 7);
    p.mayer("nothing that a solve may change", Expr(0) * p.parameter("weight", 2));
    p.mayer("a parameter", p.parameter("price", 0));
    const Trajectory guess =
        Guess(p).times(0, 7).simulated({1.5, 0}, constant_controls({})).trajectory();
    expect_period(refine(p, {.scheme = scheme, .guess = guess}),
                  4 * std::comp_ellint_1(std::sin(M_PI / 4)));
  }
}

/// Its period for a strength of 1 is 6.66328686 (Andersen & Geer, SIAM J. Appl. Math. 42, 1982).
TEST(PeriodicOrbit, OfVanDerPol) {
  for (const Scheme& scheme : schemes()) {
    SCOPED_TRACE(scheme.name);
    Oscillator of = van_der_pol();
    close(of);
    of.problem.final_time({4, 10}, 6.5);
    const Trajectory guess = Guess(of.problem)
                                 .function("x", [](double t) { return 2 * std::cos(t); })
                                 .function("v", [](double t) { return -2 * std::sin(t); })
                                 .trajectory();
    expect_period(refine(of.problem, {.scheme = scheme, .guess = guess}), 6.66328686);
  }
}

/// A pendulum's in two phases, closed by links.
TEST(PeriodicOrbit, ClosedByLinks) {
  for (const Scheme& scheme : schemes()) {
    SCOPED_TRACE(scheme.name);
    Oscillator out = pendulum("out"), back = pendulum("back");
    out.problem.initial_bounds(out.x, Bounds::equal(2.5));
    out.problem.initial_bounds(out.v, Bounds::equal(0));
    out.problem.final_time({2, 12}, 4.5);
    back.problem.initial_time({2, 12}, 4.5);
    back.problem.final_time({5, 20}, 9);
    PhasedProblem both("pendulum");
    both.link("x again", back.problem.final(back.x) - out.problem.initial(out.x));
    both.link("v again", back.problem.final(back.v) - out.problem.initial(out.v));
    both.add(out.problem);
    both.add(back.problem);
    both.connect(0, 1);
    PhasedSettings start;
    start.grids.assign(2, {Mesh::uniform(20), scheme});
    const PhasedRefined refined = refine(both, start);
    SCOPED_TRACE(refined.table());
    EXPECT_EQ(refined.status, RefineStatus::converged);
    EXPECT_NEAR(refined.solution.phases.back().tf() / (4 * std::comp_ellint_1(std::sin(1.25))), 1,
                4e-6);
    EXPECT_EQ(refined.meshes.back().objective_error, 0);
  }
}

}  // namespace
}  // namespace slalom::ocp
