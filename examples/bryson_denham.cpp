// Bryson and Denham's problem: steer a point from x = 0, v = 1 back to x = 0, v = -1 in one unit of
// time with least effort, without x ever exceeding 1/9. The least cost is 4 / (9 l) with l = 1/9.

#include <cstdio>
#include <tuple>

#include "slalom/ocp/solve.hpp"

int main() {
  using namespace slalom::ocp;

  Problem problem("Bryson-Denham");
  const Expr x = problem.state("x", Bounds::at_most(1.0 / 9)), v = problem.state("v");
  const Expr u = problem.control("u");
  problem.dynamics(x, v);
  problem.dynamics(v, u);
  problem.lagrange("effort", square(u) / 2);
  for (const auto& [state, from, to] : {std::tuple{x, 0.0, 0.0}, std::tuple{v, 1.0, -1.0}}) {
    problem.initial_bounds(state, Bounds::equal(from));
    problem.final_bounds(state, Bounds::equal(to));
  }
  const Solution solution = solve(problem);

  std::printf("%s: J = %.6f (4 exactly), largest x = %.6f\n", to_string(solution.status),
              solution.objective, solution.state("x")[solution.time().size() / 2]);
  return solution.solved() ? 0 : 1;
}
