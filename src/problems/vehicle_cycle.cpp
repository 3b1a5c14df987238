#include <cmath>

#include "slalom/planner/stated.hpp"
#include "statement.hpp"

// The planner's own problem: one cycle of the paper's closed loop.

namespace slalom::problems {
namespace {

/// The first cycle in environment E_A by planner P_C (docs/formulation.md, sections 3, 4 and 6),
/// solved to its optimum, not to a barrier floor.
Statement first_cycle() {
  planner::Settings settings;
  settings.name = "P_C";
  settings.moving_avoidance = false;
  planner::Request request;
  request.X0p = {200, 8.5, 0, 0, M_PI / 2, 0, 17, 0};
  planner::Goal goal;
  goal.x = 200;
  goal.y = 125;
  const auto cycle = planner::stated_cycle(settings, vehicle::Parameters{}, goal, {},
                                           {{.name = "O1", .x = 205, .y = 57, .a = 5, .b = 5},
                                            {.name = "O2", .x = 180, .y = 75, .a = 4, .b = 4},
                                            {.name = "O3", .x = 200, .y = 63, .a = 2, .b = 2}},
                                           request);
  return {cycle.problem, {cycle.guess}};
}

}  // namespace

Entries vehicle_cycle() {
  return {
      {.name = "vehicle",
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
       .state = first_cycle},
  };
}

}  // namespace slalom::problems
