#include "planning.hpp"

namespace slalom::sim {

FirstPlan first_plan(const Scenario& scenario, const PlanFunction& plan,
                     const std::function<bool()>& interrupted) {
  check(scenario);
  Timing timing(scenario.loop, scenario.planner.method);
  Planning planning(scenario, timing, plan, interrupted);
  FirstPlan first;
  first.warm_up = planning.warm_up();
  if (planning.interrupted()) return first;
  first.cycle = planning.first_cycle(1);
  timing.settle(*first.cycle);
  return first;
}

}  // namespace slalom::sim
