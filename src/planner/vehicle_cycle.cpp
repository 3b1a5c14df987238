#include "slalom/planner/vehicle_cycle.hpp"

#include <cmath>

#include "slalom/planner/continuous_cycle.hpp"

namespace slalom::planner {
namespace {

using problems::Tag;

problems::Statement first_cycle() {
  Task task;
  task.planner.name = "P_C";
  task.planner.moving_avoidance = false;
  task.goal = {.x = 200, .y = 125};
  task.obstacles = {{.name = "O1", .x = 205, .y = 57, .a = 5, .b = 5},
                    {.name = "O2", .x = 180, .y = 75, .a = 4, .b = 4},
                    {.name = "O3", .x = 200, .y = 63, .a = 2, .b = 2}};
  Request request;
  request.X0p = {200, 8.5, 0, 0, M_PI / 2, 0, 17, 0};
  const auto cycle = continuous_cycle(task, request);
  return {cycle.problem, {cycle.guess}};
}

}  // namespace

problems::Entry vehicle_cycle() {
  return {
      .name = "vehicle",
      .title = "The planner's first cycle among three obstacles",
      .source = "Febbo et al.; docs/formulation.md, sections 3 and 6, E_A by P_C",
      .hard = "a tyre model, slacks, obstacles either side of which a way leads",
      .tags = {Tag::state_constraint, Tag::local_optima, Tag::free_final_time},
      .converged = 251.0772,
      .remark =
          "by tol 1e-12 HS ends at 251.07703 on 100 intervals, at 251.07722 on 400; at tol 1e-8 "
          "the many bounds' complementarities add .03 to it",
      .tol = 1e-10,
      .resolve_controls = false,
      .intervals = 100,
      .state = first_cycle};
}

}  // namespace slalom::planner
