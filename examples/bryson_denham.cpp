// Bryson and Denham's problem: steer a point from x = 0, v = 1 back to x = 0, v = -1 in one unit of
// time with least effort, without x ever exceeding 1/9. The least cost is 4 / (9 l) with l = 1/9.
// Refined until re-integration confirms the answer to 1e-6.

#include <cstdio>

#include "slalom/ocp.hpp"

int main() {
  using namespace slalom::ocp;

  Problem problem("Bryson-Denham");
  const Expr x = problem.state("x", Bounds::at_most(1.0 / 9)), v = problem.state("v");
  const Expr u = problem.control("u");
  problem.dynamics(x, v);
  problem.dynamics(v, u);
  problem.lagrange("effort", square(u) / 2);
  problem.fix(x, 0, 0);
  problem.fix(v, 1, -1);
  const Refined refined = refine(problem);

  std::printf("%s: J = %.6f (4 exactly), largest error of an interval %.1e\n",
              to_string(refined.status), refined.solution.objective, refined.errors.largest);
  return refined.status == RefineStatus::converged ? 0 : 1;
}
