#include "slalom/planner/planner.hpp"
#include "slalom/sim/closed_loop.hpp"

namespace slalom::sim {

Drive drive(const Scenario& scenario, const LoopHooks& hooks) {
  check(scenario, scenario.name.empty() ? "scenario" : scenario.name);
  planner::Planner planner(scenario);
  if (hooks.record.take) planner.record(hooks.record);
  const PlanFunction plan = [&](const planner::Request& request) { return planner.plan(request); };
  return drive(scenario, plan, hooks);
}

}  // namespace slalom::sim
