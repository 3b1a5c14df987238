#include "planning.hpp"

#include <algorithm>
#include <cmath>

#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"

namespace slalom::sim {

void check(const Scenario& scenario) {
  check(scenario, scenario.name.empty() ? "scenario" : scenario.name);
}

Planning::Planning(const Scenario& scenario, const Timing& timing, const PlanFunction& plan,
                   const std::function<bool()>& interrupted)
    : scenario_(scenario),
      timing_(timing),
      plan_(plan),
      interrupted_(interrupted),
      believed_(scenario.vehicle, scenario.loop.plant_tolerance, scenario.loop.sample_step),
      sensors_(scenario.sensing, scenario.plant.cg_shift) {}

double Planning::known_actuator_delay() const {
  return scenario_.loop.compensate_delay ? scenario_.plant.actuator_delay : 0;
}

/// The state when the plan of a cycle that begins at t0 acts: on from what is measured by what is
/// commanded. A planner that knows of delays takes the measurement for what it is, a state some
/// time ago, and the vehicle for driven by what was commanded before.
vehicle::State Planning::predicted(const vehicle::State& measured, double t0,
                                   const Actuator& actuator) {
  const double begin = timing_.plan_start(t0);
  rehearsal_.begin_anew();
  if (!scenario_.loop.compensate_delay)
    return rehearsal_.predict(believed_, measured, actuator.commanded(), t0, begin);
  const double until = begin + known_actuator_delay();
  vehicle::State state = measured;
  for (double t = std::max(t0 - scenario_.sensing.delay, 0.0); t < until;) {
    const double next = std::min(until, actuator.next_change(t));
    state = rehearsal_.predict(believed_, state, actuator.driven(t), t, next);
    t = next;
  }
  return state;
}

Cycle Planning::cycle(int index, double t0, const History& history, const Actuator& actuator,
                      bool last_was_late) {
  Cycle cycle;
  cycle.index = index;
  cycle.t0 = t0;
  cycle.tex = scenario_.loop.tex;
  try {
    const auto measured = sensors_.measured(history(t0 - scenario_.sensing.delay), index);
    cycle.X0p = predicted(measured, t0, actuator);
  } catch (const vehicle::PlantError& error) {
    cycle.X0p.fill(std::nan(""));
    cycle.plan.report.status = planner::PlanStatus::no_prediction;
    cycle.plan.report.detail = error.what();
    return cycle;
  }
  const planner::Request request = this->request(cycle, last_was_late);
  try {
    planner::check(request, "request");
  } catch (const InvalidValue& error) {
    // What is measured and predicted may be of no vehicle.
    cycle.plan.report.status = planner::PlanStatus::no_prediction;
    cycle.plan.report.detail = error.what();
    return cycle;
  }
  const Timer timer;
  cycle.plan = plan_(request);
  cycle.solve_time = std::max(timer.wall(), cycle.plan.report.wall_s);
  return cycle;
}

planner::Request Planning::request(const Cycle& cycle, bool last_was_late) const {
  const LoopSettings& loop = scenario_.loop;
  planner::Request request;
  request.X0p = cycle.X0p;
  request.t0 = cycle.t0;
  request.t_start = timing_.plan_start(cycle.t0) + known_actuator_delay();
  request.tex = loop.tex;
  request.obstacles = sensors_.believed(scenario_.obstacles, cycle.index, cycle.t0);
  request.time_limit = timing_.time_limit();
  request.clock_limit = timing_.clock_limit();
  request.warm_up = cycle.index == 0;
  request.last_was_late = last_was_late;
  if (loop.on_failure == OnFailure::best_iterate) request.best_iterate_tol = loop.best_iterate_tol;
  request.interrupted = interrupted_;
  return request;
}

Cycle Planning::first_cycle(int index) {
  const Actuator still(scenario_.plant.actuator_delay);
  return cycle(
      index, 0, [this](double) { return scenario_.start; }, still, false);
}

std::optional<Cycle> Planning::warm_up() {
  if (!scenario_.loop.warm_up || interrupted()) return std::nullopt;
  return first_cycle(0);
}

}  // namespace slalom::sim
