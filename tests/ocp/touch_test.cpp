// Refinement where a state touches a bound between the points of a mesh: states and controls are
// right there, and the objective is better than the problem's.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "slalom/ocp/refine.hpp"

namespace slalom::ocp {
namespace {

/// x^(order) = u from (0, 1, 0 ...) to (0, -1, 0 ...) below a bound, by least effort.
Problem below(double bound, int order) {
  Problem p("below");
  std::vector<Expr> x{p.state("x", Bounds::at_most(bound))};
  for (int i = 1; i < order; ++i)
    x.push_back(p.state(std::string(static_cast<std::size_t>(i), 'd')));
  const Expr u = p.control("u");
  for (int i = 0; i < order; ++i) p.dynamics(x[i], i + 1 < order ? x[i + 1] : u);
  for (int i = 0; i < order; ++i) p.fix(x[i], i == 1 ? 1 : 0, i == 1 ? -1 : 0);
  p.lagrange("effort", square(u) / 2);
  return p;
}

/// A ceiling over time that is touched once.
Problem under_a_ceiling() {
  Problem p("ceiling");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u");
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.fix(x, 0, 0);
  p.fix(v, 1, 0);
  p.path("ceiling", x - 0.14 - 0.1 * square(p.time() - 0.37), Bounds::at_most(0));
  p.lagrange("effort", square(u));
  return p;
}

struct Touch {
  Problem problem;
  double value;  ///< 1280 intervals of Hermite-Simpson; on 640 the same to 4e-9
};

TEST(Touch, BetweenPointsIsSeenAndCutByBothSchemes) {
  for (const auto& [problem, value] : {Touch{below(0.05, 3), 7000.7432},
                                       {below(0.12, 3), 633.163776},
                                       {under_a_ceiling(), 4.017675977}})
    for (const SolveSettings& start :
         {SolveSettings{.mesh = Mesh::uniform(40)}, SolveSettings{.mesh = Mesh::uniform(37)},
          SolveSettings{.mesh = Mesh::uniform(20), .scheme = lgr(4)},
          SolveSettings{.mesh = Mesh::uniform(19), .scheme = lgr(4)}}) {
      const bool hp = start.scheme.of(0).name == "lgr";
      const Refined refined =
          refine(problem, start, {.refinement = hp ? Refinement::hp : Refinement::h});
      SCOPED_TRACE(refined.table());
      EXPECT_EQ(refined.status, RefineStatus::converged);
      EXPECT_NEAR(refined.solution.objective / value, 1, 1e-5);
      EXPECT_LE(refined.meshes.size(), 6u);
      EXPECT_LE(refined.meshes.back().points, 250u);
    }
}

TEST(Touch, SharesSayHowFarTheObjectiveIsOff) {
  const Problem problem = under_a_ceiling();
  const Solution solution = solve(problem, {.mesh = Mesh::uniform(40)});
  const ErrorEstimate errors = estimate_errors(problem, solution);
  double sum = 0;
  for (const double share : errors.bound_share) sum += share;
  const double off = 4.017675977 - solution.objective;
  EXPECT_GT(off, 1e-5);
  EXPECT_GT(sum, 0.5 * off);
  EXPECT_LT(sum, 5 * off);
  EXPECT_LT(errors.largest, 1e-9) << "which re-integration does not see";
  const auto most = std::max_element(errors.bound_share.begin(), errors.bound_share.end());
  const auto k = static_cast<std::size_t>(most - errors.bound_share.begin());
  const Violation violation = largest_violation(problem, solution);
  EXPECT_EQ(violation.constraint, "ceiling");
  EXPECT_GE(violation.time, solution.mesh.breakpoints()[k] - 1e-9);
  EXPECT_LE(violation.time, solution.mesh.breakpoints()[k + 1] + 1e-9);
}

/// Bounds of controls are the matter of unresolved_controls, soft ones may be violated.
TEST(Touch, IsNotOfControlsNorOfSoftBounds) {
  Problem p("soft");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u", {-6, 6});
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.fix(x, 0, 0);
  p.fix(v, 1, -1);
  p.soften(p.path("wall", x, Bounds::at_most(0.15)), {.weight = 30});
  p.lagrange("effort", square(u) / 2);
  const Solution solution = solve(p, {.mesh = Mesh::uniform(11)});
  ASSERT_TRUE(solution.solved());
  for (const double share : estimate_errors(p, solution).bound_share) EXPECT_EQ(share, 0);
}

}  // namespace
}  // namespace slalom::ocp
