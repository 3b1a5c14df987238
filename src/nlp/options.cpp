#include <cmath>
#include <limits>

#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {
namespace {

using Range = OptionRange;

OptionTable<Options> make_table() {
  using O = Options;
  OptionTable<Options> table;
  table
      .real(
          "floor", &O::floor, Range::non_negative(), "objective",
          "Barrier floor mu: the solve ends at the central point of mu instead of the optimum; 0: "
          "none. A row's scale does not move that point, the objective's does, so a solve at a "
          "floor scales neither.")
      .real(
          "tol", &O::tol, Range::positive(), "1",
          "Without a floor: scaled optimality error (Waechter & Biegler 2006, eq. 5) at which the "
          "solve ends. 1e-8 leaves digits to spare over what a collocation error usually asks for.")
      .real("dual_tol", &O::dual_tol, Range::positive(), "objective",
            "Largest |gradient of the Lagrangian|, and without a floor largest |slack * "
            "multiplier|, of a solved problem, in the user's units. The checker judges by it too.")
      .real("constraint_tol", &O::constraint_tol, Range::positive(), "of the row",
            "Largest violation of a row of a solved problem, in the user's units, or the rounding "
            "of the row's own terms where that is more; also what counts as met among the points "
            "an unsolved problem is answered with. Without a floor, the check and other back ends "
            "than interior_point take it in the units of the scales.")
      .real("floor_tol", &O::floor_tol, Range::positive(), "1",
            "At a floor: largest |slack * multiplier / mu - 1|. One percent of the distance to the "
            "limits is far below what a plan can feel.")
      .integer("max_iterations", &O::max_iterations, Range::closed(0, 1000000000), "1",
               "Iterations, of the restoration phase too, after which the solve gives up. Solves "
               "that succeed rarely take a tenth of the default.")
      .real("time_limit", &O::time_limit, Range::non_negative(), "s",
            "Deadline in this thread's processor time, callbacks not counted: the operating "
            "system's share and the user's code are not the solver's. solve() and refine() of "
            "optimal control count by the clock, over set-up and all their solves. Infinite by "
            "default.")
      .boolean("warm_start", &O::warm_start,
               "The start's multipliers are used. Off by default, for a guess has none.")
      .choice(
          "barrier_rule", &O::barrier_rule, {"monotone", "adaptive"},
          "How mu falls without a floor, in interior_point. adaptive follows how far a step to mu "
          "= 0 would get, takes its second-order terms off the next, and falls back to monotone "
          "when the error does not fall; it takes fewer iterations on most problems.")
      .integer("print_level", &O::print_level, Range::closed(0, 12), "1",
               "Detail of the back end's log on standard output; 0: none.")
      .text("nl_solver", &O::nl_solver,
            "Of back end nl: the solver's executable, a path or a name looked for in PATH. Ipopt, "
            "KNITRO and ripopt, known by how the name begins, are told the options above in "
            "their own words; others take nl_options alone.")
      .text("nl_options", &O::nl_options,
            "Of back end nl: words for the solver's command line, such as `max_iter=100 "
            "linear_solver=ma57`; they come last and win.");
  return table;
}

}  // namespace

const OptionTable<Options>& solver_options() {
  static const OptionTable<Options> table = make_table();
  return table;
}

void check(const Options& options, const std::string& where) {
  Options finite = options;
  if (finite.time_limit == std::numeric_limits<double>::infinity())
    finite.time_limit = std::numeric_limits<double>::max();
  for (const auto& entry : solver_options().entries())
    if (entry.info.kind != OptionKind::choice)  // an enum has no other values; a solve, no memory
      (void)entry.info.checked(entry.get(finite), where);
}

}  // namespace slalom::nlp
