// Answers that are stationary and break the minimum principle are left for lower ones.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "ocp/closed_forms.hpp"
#include "slalom/ocp/refine.hpp"

namespace slalom::ocp {
namespace {

/// The greatest final speed along x of a unit thrust whose angle is free, from rest to rest along
/// y at y = 1 (Bryson & Ho 1975, p. 59): linear-tangent steering.
Problem orbit_injection() {
  Problem p("orbit injection");
  const Expr u = p.state("u"), v = p.state("v"), y = p.state("y", Bounds::at_least(0));
  const Expr angle = p.control("angle", {-M_PI, M_PI});
  p.dynamics(u, cos(angle));
  p.dynamics(v, sin(angle));
  p.dynamics(y, v);
  p.initial_bounds(u, Bounds::equal(0));
  p.fix(v, 0, 0);
  p.fix(y, 0, 1);
  p.final_time(Bounds::equal(2.05), 2.05);
  p.mayer("speed", -p.final(u));
  return p;
}

TEST(MinimumPrinciple, AnAnswerThatIsOnlyStationaryIsLeft) {
  const Refined refined = refine(orbit_injection());
  SCOPED_TRACE(refined.table());
  EXPECT_EQ(refined.status, RefineStatus::converged);
  // By the indirect conditions to ten digits.
  EXPECT_NEAR(refined.solution.objective, -0.8047832094, 1e-6);
  EXPECT_LE(refined.hamiltonian_gap, 1e-6);
}

/// A becomes B, and B is lost faster the greater u: from a guess in the middle of u's bounds all of
/// it is lost, where no small step of u helps.
Problem reactor() {
  Problem p("reactor");
  const Expr a = p.state("a"), b = p.state("b");
  const Expr u = p.control("u", {0.01, 8});
  p.dynamics(a, -u * a);
  p.dynamics(b, u * a - 2.5 * pow(u, 1.5) * b);
  p.initial_bounds(a, Bounds::equal(1));
  p.initial_bounds(b, Bounds::equal(0.01));
  p.final_time(Bounds::equal(8), 8);
  p.mayer("yield", -p.final(b));
  return p;
}

TEST(MinimumPrinciple, HoldsByEveryScheme) {
  for (const Schemes& scheme :
       {Schemes(hermite_simpson()), Schemes(lgr(3)), Schemes(trapezoidal())}) {
    const Refined refined = refine(reactor(), {.scheme = scheme}, {.tolerance = 1e-5});
    SCOPED_TRACE(refined.table());
    EXPECT_EQ(refined.status, RefineStatus::converged);
    EXPECT_LT(refined.solution.objective, -0.4);
  }
}

TEST(MinimumPrinciple, HasNoGapWhereTheAnswerIsTheMinimum) {
  for (const auto& form : {brachistochrone(), least_time(), bryson_denham(1.0 / 9), regulator()}) {
    const Refined refined = refine(form.problem, {.guess = form.guess});
    SCOPED_TRACE(form.problem.name() + "\n" + refined.table());
    EXPECT_EQ(refined.status, RefineStatus::converged);
    EXPECT_LE(refined.hamiltonian_gap, 1e-6 * std::fabs(refined.solution.objective));
    EXPECT_NEAR(refined.solution.objective, form.objective, 1e-5);
  }
}

/// The first half and then the second of orbit_injection().
TEST(MinimumPrinciple, IsHeldByEachPhase) {
  const auto half = [](const std::string& name, bool first) {
    Problem p(name);
    const Expr u = p.state("u"), v = p.state("v"), y = p.state("y", Bounds::at_least(0));
    const Expr angle = p.control("angle", {-M_PI, M_PI});
    p.dynamics(u, cos(angle));
    p.dynamics(v, sin(angle));
    p.dynamics(y, v);
    if (first) {
      for (const Expr& each : {u, v, y}) p.initial_bounds(each, Bounds::equal(0));
      p.final_time(Bounds::equal(1), 1);
    } else {
      p.initial_time(Bounds::equal(1), 1);
      p.final_time(Bounds::equal(2.05), 2.05);
      p.final_bounds(v, Bounds::equal(0));
      p.final_bounds(y, Bounds::equal(1));
      p.mayer("speed", -p.final(u));
    }
    return p;
  };
  PhasedProblem whole("orbit injection");
  whole.add(half("up", true));
  whole.add(half("down", false));
  whole.connect(0, 1);
  const PhasedRefined refined = refine(whole);
  SCOPED_TRACE(refined.table());
  EXPECT_EQ(refined.status, RefineStatus::converged);
  EXPECT_NEAR(refined.solution.objective, -0.8047832094, 1e-6);
}

}  // namespace
}  // namespace slalom::ocp
