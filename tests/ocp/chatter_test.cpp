// Refinement where the best control is singular: a mesh's own answer goes to and fro from point to
// point, for it makes use of the scheme's error.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ocp/closed_forms.hpp"
#include "slalom/ocp/refine.hpp"

namespace slalom::ocp {
namespace {

/// Of Jackson's problem: u = 1, then, on the arc where a / b stays the same, 0.2271, then 0. The
/// best times and value of u of that form, by integration of it to 1e-12.
constexpr double kMostProduct = 0.191814356325;

/// Jackson, J. Optim. Theory Appl. 2(4), 1968: a catalyst mixed along a reactor, a <-> b -> c; `c`
/// is what comes out. From t0 to tf; `begins` with a alone.
Problem jackson(const std::string& name, double t0, double tf, bool begins, bool ends) {
  Problem p(name);
  const Expr a = p.state("a"), b = p.state("b"), c = p.state("c"), u = p.control("u", {0, 1});
  const Expr r = u * (a - 10 * b);
  p.dynamics(a, -r);
  p.dynamics(b, r - (1 - u) * b);
  p.dynamics(c, (1 - u) * b);
  p.initial_time(Bounds::equal(t0), t0);
  p.final_time(Bounds::equal(tf), tf);
  if (begins) {
    p.initial_bounds(a, Bounds::equal(1));
    p.initial_bounds(b, Bounds::equal(0));
    p.initial_bounds(c, Bounds::equal(0));
  }
  if (ends) p.mayer("product", -p.final(c));
  return p;
}
Problem jackson() {
  return jackson("jackson", 0, 4, true, true);
}

SolveSettings by_lgr() {
  return {.mesh = Mesh::uniform(20), .scheme = lgr(4)};
}

/// Known to the tolerance, by few points, and no further off than it says.
template <class Refined>
void expect_known(const Refined& refined) {
  SCOPED_TRACE(refined.table());
  EXPECT_EQ(refined.status, RefineStatus::converged);
  EXPECT_LE(refined.meshes.back().points, 3000u);
  EXPECT_GT(refined.meshes.back().damping, 0);
  const double error = std::fabs(-refined.solution.objective / kMostProduct - 1);
  EXPECT_LE(error, 1e-5);
  EXPECT_LE(error, 4 * refined.meshes.back().objective_error + 1e-7);
}

TEST(Chatter, IsDampedUntilTheObjectiveIsKnown) {
  expect_known(refine(jackson()));
  expect_known(refine(jackson(), by_lgr(), {.refinement = Refinement::hp}));
  const Refined without = refine(jackson(), {}, {.damp_chatter = false, .max_size = 3000});
  EXPECT_EQ(without.status, RefineStatus::size_limit) << without.table();
}

TEST(Chatter, IsDampedInPhases) {
  PhasedProblem both("jackson in two phases");
  both.add(jackson("first", 0, 1, true, false));
  both.add(jackson("second", 1, 4, false, true));
  both.connect(0, 1, {.without = {"time"}});
  PhasedSettings start;
  start.grids.assign(2, {Mesh::uniform(20), hermite_simpson()});
  expect_known(refine(both, start));
}

TEST(Chatter, LeavesNoTraceInTheAnswer) {
  const Refined refined = refine(jackson());
  ASSERT_EQ(refined.solution.cost_terms.size(), 1u);
  EXPECT_EQ(refined.solution.cost_terms[0].second, refined.solution.objective);
  EXPECT_NEAR(refined.solution.objective, -refined.solution.state("c").back(), 1e-12);
  EXPECT_NE(refined.table().find("damping"), std::string::npos);
}

/// What a barrier keeps a control off its bound differs from point to point, and is no swing.
TEST(Chatter, IsNotTheBarriers) {
  Problem p("ahead");
  const Expr x = p.state("x"), u = p.control("u", {0, 1});
  p.dynamics(x, u * (1 + sin(60 * p.time())) + 1e-9);
  p.initial_bounds(x, Bounds::equal(0));
  p.mayer("way", -p.final(x));
  const Refined refined = refine(p, by_lgr(), {.tolerance = 1e-9, .refinement = Refinement::hp});
  for (const MeshRecord& mesh : refined.meshes) EXPECT_EQ(mesh.damping, 0) << refined.table();
}

/// Many swings that a mesh resolves are none, nor are many jumps.
TEST(Chatter, IsNoControlThatAMeshResolves) {
  Problem p("follows");
  const Expr x = p.state("x"), u = p.control("u", {-2, 2});
  p.dynamics(x, u);
  p.initial_bounds(x, Bounds::equal(0));
  p.lagrange("cost", square(x - sin(40 * p.time()) / 40) + 1e-4 * square(u));
  for (const auto& refined :
       {refine(p), refine(p, by_lgr(), {.refinement = Refinement::hp}),
        refine(moon_lander().problem), refine(bryson_denham(1.0 / 9).problem)}) {
    EXPECT_EQ(refined.status, RefineStatus::converged);
    for (const MeshRecord& mesh : refined.meshes) EXPECT_EQ(mesh.damping, 0) << refined.table();
  }
}

}  // namespace
}  // namespace slalom::ocp
