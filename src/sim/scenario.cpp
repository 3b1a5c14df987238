#include "slalom/sim/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "slalom/base/error.hpp"
#include "slalom/sim/latency.hpp"
#include "slalom/vehicle/model.hpp"

namespace slalom::sim {
namespace {

using Range = OptionRange;

/// Throws InvalidValue at "where, what" unless `value` lies in [lo, hi].
void require_within(double value, double lo, double hi, const std::string& where,
                    const std::string& what, const std::string& reason) {
  if (value >= lo && value <= hi) return;
  throw InvalidValue(fmt::format("{}: {}", where, what), fmt::format("{:.9g}", value),
                     fmt::format("{:.9g} to {:.9g} ({})", lo, hi, reason));
}

void require_finite(double value, const std::string& where, const std::string& what) {
  if (!std::isfinite(value))
    throw InvalidValue(fmt::format("{}: {}", where, what), fmt::format("{}", value),
                       "a finite number");
}

void require_positive(double value, const std::string& where, const std::string& what) {
  if (!std::isfinite(value) || value <= 0)
    throw InvalidValue(fmt::format("{}: {}", where, what), fmt::format("{}", value),
                       "a finite number > 0");
}

void check_goal_and_region(const Scenario& s, const std::string& where) {
  require_finite(s.goal.x, where, "goal x");
  require_finite(s.goal.y, where, "goal y");
  require_finite(s.goal.psi, where, "goal psi");
  require_positive(s.goal.sigma, where, "goal sigma");
  const auto side = [&](double lo, double hi, const char* axis) {
    if (!(lo < hi))
      throw InvalidValue(fmt::format("{}: region", where),
                         fmt::format("{0}_min = {1}, {0}_max = {2}", axis, lo, hi),
                         fmt::format("{0}_min < {0}_max", axis));
  };
  side(s.region.x_min, s.region.x_max, "x");
  side(s.region.y_min, s.region.y_max, "y");
}

void check_obstacles(const Scenario& s, const std::string& where) {
  for (const auto& obstacle : s.obstacles) {
    const auto name = [&](const char* key) {
      return fmt::format("obstacle {} {}", obstacle.name, key);
    };
    require_finite(obstacle.x, where, name("x"));
    require_finite(obstacle.y, where, name("y"));
    require_finite(obstacle.vx, where, name("vx"));
    require_finite(obstacle.vy, where, name("vy"));
    require_positive(obstacle.a, where, name("a"));
    require_positive(obstacle.b, where, name("b"));
  }
}

void check_start_bounds(const Scenario& s, const vehicle::Parameters& driven,
                        const std::string& where) {
  using namespace vehicle;
  const State& start = s.start;
  const Parameters& car = s.vehicle;
  for (std::size_t i = 0; i < kStates; ++i)
    require_finite(start[i], where, fmt::format("start {}", kStateNames[i]));
  require_within(start[X], s.region.x_min, s.region.x_max, where, "start x", "the region");
  require_within(start[Y], s.region.y_min, s.region.y_max, where, "start y", "the region");
  require_within(start[PSI], -car.psi_max, car.psi_max, where, "start psi", "psi_max, in rad");
  require_within(start[SA], -car.sa_max(), car.sa_max(), where, "start sa", "sa_max_deg, in rad");
  require_within(start[UX], car.ux_min, car.ux_max, where, "start ux", "ux_min to ux_max, in m/s");
  require_within(start[AX], car.ax_min_at(start[UX]), car.ax_max_at(start[UX]), where, "start ax",
                 "ax_min to ax_max at the start's ux, in m/s^2");
  const WheelLoads loads = Dynamics(driven).wheel_loads(start);
  for (std::size_t i = 0; i < kWheels; ++i)
    if (!(loads[i] >= s.loop.Fz_failure))
      throw InvalidValue(fmt::format("{}: start", where),
                         fmt::format("{} = {:.6g} N", kWheelNames[i], loads[i]),
                         fmt::format("at least Fz_failure = {:.6g} N", s.loop.Fz_failure));
}

void check_start_clear(const Scenario& s, const std::string& where) {
  for (const auto& obstacle : s.obstacles) {
    const double clearance = world::distance(obstacle.grown(s.loop.sm_crash), s.start[vehicle::X],
                                             s.start[vehicle::Y], 0);
    if (!(clearance >= 0))
      throw InvalidValue(
          fmt::format("{}: start", where),
          fmt::format("({:.6g}, {:.6g}), {:.6g} m inside obstacle {} grown by sm_crash = {:.6g} m",
                      s.start[vehicle::X], s.start[vehicle::Y], -clearance, obstacle.name,
                      s.loop.sm_crash),
          "a start outside every grown obstacle");
  }
}

}  // namespace

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
        .choice("deadline", &L::deadline, {"off", "tex"},
                "tex: planning ends within the execution horizon, in thread time, solved or not; "
                "off: within solve_time_limit, as in the paper.")
        .choice(
            "latency", &L::latency, {"instant", "paper", "measured", "recorded", "model"},
            "When a plan takes effect. instant: the plant waits for it and nothing is predicted; "
            "paper: after the execution horizon, a late one too; measured: a late one when it is "
            "ready, while the old one runs on, by the wall clock; recorded, model: the same by "
            "solve_times, or by times drawn from a lognormal distribution. The last two are "
            "deterministic; with deadline tex, a cycle charged more than tex yields no plan.")
        .numbers(
            "solve_times", &L::solve_times, Range::non_negative(), "s",
            "Of latency recorded: one a cycle, again from the first after the last; a list, or "
            "a CSV file with the column solve_time_s (a drive's cycles.csv), or one a line.")
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
        .boolean("warm_up", &L::warm_up,
                 "Solve the first OCP once before the clock starts, as the paper warm-starts its "
                 "optimisations.",
                 "formulation section 4")
        .real("sm_crash", &L::sm_crash, Range::non_negative(), "m",
              "Margin by which obstacles grow in the plant's crash check (the paper's sm).",
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

void check(const Scenario& scenario, const std::string& where) {
  planner::check(scenario.planner, where);
  vehicle::check(scenario.vehicle, where);
  loop_options().check(scenario.loop, where);
  plant_options().check(scenario.plant, where + ": plant");
  sensing_options().check(scenario.sensing, where + ": sensing");
  if (scenario.loop.tex > scenario.planner.tf_max)
    throw InvalidValue(where, fmt::format("tex = {}", scenario.loop.tex),
                       fmt::format("at most tf_max = {}", scenario.planner.tf_max));
  (void)Latency(scenario.loop);
  check_goal_and_region(scenario, where);
  check_obstacles(scenario, where);
  check_start_bounds(scenario, plant_vehicle(scenario.vehicle, scenario.plant, where), where);
  if (scenario.planner.model == vehicle::ModelKind::constant_speed &&
      scenario.start[vehicle::AX] != 0)
    throw InvalidValue(fmt::format("{}: start ax", where),
                       fmt::format("{:.9g}", scenario.start[vehicle::AX]),
                       "0, for planner model constant_speed holds the speed");
  check_start_clear(scenario, where);
}

}  // namespace slalom::sim
