#include "slalom/planner/continuous_cycle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slalom/ocp/solve.hpp"

namespace slalom::planner {
namespace {

/// Section 6 of docs/formulation.md: the first OCP of P_B in E_A at floor .8.
TEST(ContinuousCycle, IsThePlannersProblem) {
  Task task;
  task.planner.w_ce = 0;
  task.planner.moving_avoidance = false;
  task.goal = {.x = 200, .y = 125};
  task.obstacles = {{.name = "O1", .x = 205, .y = 57, .a = 5, .b = 5},
                    {.name = "O2", .x = 180, .y = 75, .a = 4, .b = 4},
                    {.name = "O3", .x = 200, .y = 63, .a = 2, .b = 2}};
  Request request;
  request.X0p = {200, 8.5, 0, 0, M_PI / 2, 0, 17, 0};
  const auto cycle = continuous_cycle(task, request);
  ocp::SolveSettings solve;
  solve.mesh = ocp::Mesh::uniform(10);
  solve.scheme = ocp::trapezoidal();
  solve.guess = cycle.guess;
  solve.options.floor = 0.8;
  const auto solution = ocp::solve(cycle.problem, solve);
  ASSERT_TRUE(solution.solved());
  EXPECT_NEAR(solution.objective, 271.6379, 0.05);
  EXPECT_NEAR(solution.tf(), 2.515208, 1e-3);
  EXPECT_NEAR(solution.state("x").back(), 196.49608, 1e-2);
}

}  // namespace
}  // namespace slalom::planner
