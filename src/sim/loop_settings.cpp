#include "slalom/sim/loop_settings.hpp"

namespace slalom::sim {

using Range = OptionRange;

const OptionTable<LoopSettings>& loop_options() {
  using L = LoopSettings;
  static const auto table = [] {
    OptionTable<LoopSettings> options;
    options
        .real("tex", &L::tex, {.lo = 0.001}, "s",
              "Execution horizon: how long each plan is driven, and how far ahead the state is "
              "predicted. At most tf_max.",
              "paper, table of simulation parameters")
        .real("timeout", &L::timeout, Range::positive(), "s",
              "Longest drive; then its outcome is timeout.", "formulation section 4")
        .real("solve_time_limit", &L::solve_time_limit, Range::positive(), "s",
              "Wall-clock time of one solve beyond which the drive fails as solve_time.",
              "paper, section II; formulation section 4")
        .choice("deadline", &L::deadline, {"by_planner", "off", "tex"},
                "tex: planning ends within the execution horizon, in thread time, solved or not; "
                "off: within solve_time_limit, as in the paper. by_planner: tex for a planner that "
                "verifies its plans, for it always has one, and off for others.")
        .choice(
            "latency", &L::latency, {"instant", "paper", "measured", "recorded", "model"},
            "When a plan takes effect. instant: the plant waits for it and nothing is predicted; "
            "paper: after the execution horizon, a late one too; measured: a late one when it is "
            "ready, while the old one runs on, by the wall clock; recorded, model: the same by "
            "solve_times, or by times drawn from a lognormal distribution. The last two are "
            "deterministic; with deadline tex, a cycle charged more than tex yields no plan.")
        .numbers(
            "solve_times", &L::solve_times, Range::non_negative(), "s",
            "Of latency recorded: one for each cycle, again from the first after the last; a list, "
            "or "
            "a CSV file with the column solve_time_s (a drive's cycles.csv), or one on each line.")
        .real("latency_median", &L::latency_median, Range::non_negative(), "s",
              "Of latency model: median of the solve times.")
        .real(
            "latency_spread", &L::latency_spread, Range::closed(0, 5), "1",
            "Of latency model: standard deviation of the solve times' logarithm; 0 for all alike.")
        .integer("latency_seed", &L::latency_seed, Range::closed(0, 2147483647), "1",
                 "Of latency model: the same seed gives the same times.")
        .choice("on_failure", &L::on_failure, {"stop", "last_plan", "best_iterate"},
                "When the NLP is not solved: stop ends the drive as not_optimal, as in the paper; "
                "last_plan drives on with the last plan, its last control held past its end; "
                "best_iterate takes the best iterate the solver met if it is within "
                "best_iterate_tol, else drives on with the last plan.")
        .real("best_iterate_tol", &L::best_iterate_tol, Range::non_negative(), "unit of the row",
              "Largest violation of a constraint with which best_iterate drives a plan that is not "
              "solved: metres of a defect of position, newtons of a wheel load.")
        .boolean(
            "compensate_delay", &L::compensate_delay,
            "The planner knows of sensing.delay and plant.actuator_delay: it predicts from the "
            "time of the measurement, by what the plant drove and will drive of what was "
            "commanded, to when its plan acts, and the plan is commanded that much earlier.")
        .boolean("warm_up", &L::warm_up,
                 "Solve the first OCP once before the clock starts, as the paper warm-starts its "
                 "optimisations.",
                 "formulation section 4")
        .real("sm_crash", &L::sm_crash, Range::non_negative(), "m",
              "Margin by which obstacles grow in the plant's crash check (the paper's sm). Where a "
              "file does not state it and the vehicle's footprint is a rectangle, it is 0.",
              "paper, table of simulation parameters")
        .real("Fz_failure", &L::Fz_failure, Range::any(), "N",
              "Wheel load below which the plant fails as wheel_lift.", "paper, section II")
        .real("plant_tolerance", &L::plant_tolerance, Range::closed(1e-13, 1e-6), "1",
              "Relative and absolute tolerance of each step of the plant's integrator.",
              "formulation section 4 asks for 1e-6 or better")
        .real("sample_step", &L::sample_step, Range::closed(1e-4, 0.02), "s",
              "Longest time between recorded samples of the plant.");
    return options;
  }();
  return table;
}

}  // namespace slalom::sim
