#include "planning.hpp"

#include <algorithm>
#include <cmath>

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

Cycle Planning::cycle(int index, double t0, const History& history,
                      const vehicle::ControlSignal& commanded) const {
  Cycle cycle;
  cycle.index = index;
  cycle.t0 = t0;
  cycle.tex = scenario_.loop.tex;
  try {
    const auto measured = sensors_.measured(history(t0 - scenario_.sensing.delay), index);
    cycle.X0p = believed_.predict(measured, commanded, t0, timing_.plan_start(t0));
  } catch (const vehicle::PlantError& error) {
    cycle.X0p.fill(std::nan(""));
    cycle.plan.report.status = planner::PlanStatus::no_prediction;
    cycle.plan.report.detail = error.what();
    return cycle;
  }
  const planner::Request request = this->request(cycle);
  const Timer timer;
  cycle.plan = plan_(request);
  cycle.solve_time = std::max(timer.wall(), cycle.plan.report.wall_s);
  return cycle;
}

planner::Request Planning::request(const Cycle& cycle) const {
  const LoopSettings& loop = scenario_.loop;
  planner::Request request;
  request.X0p = cycle.X0p;
  request.t0 = cycle.t0;
  request.t_start = timing_.plan_start(cycle.t0);
  request.obstacles = sensors_.believed(scenario_.obstacles, cycle.index, cycle.t0);
  request.time_limit = timing_.time_limit();
  request.warm_up = cycle.index == 0;
  if (loop.on_failure == OnFailure::best_iterate) request.best_iterate_tol = loop.best_iterate_tol;
  request.interrupted = interrupted_;
  return request;
}

Cycle Planning::first_cycle(int index) const {
  return cycle(index, 0, [this](double) { return scenario_.start; }, {});
}

std::optional<Cycle> Planning::warm_up() const {
  if (!scenario_.loop.warm_up || interrupted()) return std::nullopt;
  return first_cycle(0);
}

}  // namespace slalom::sim
