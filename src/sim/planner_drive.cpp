#include "planning.hpp"
#include "slalom/planner/planner.hpp"

namespace slalom::sim {

Drive drive(const Scenario& scenario, const LoopHooks& hooks) {
  check(scenario);
  planner::Planner planner(scenario);
  if (hooks.record.take) planner.record(hooks.record);
  const PlanFunction plan = [&](const planner::Request& request) { return planner.plan(request); };
  return drive(scenario, plan, hooks);
}

FirstPlan first_plan(const Scenario& scenario, const std::function<bool()>& interrupted) {
  check(scenario);
  planner::Planner planner(scenario);
  const PlanFunction plan = [&](const planner::Request& request) { return planner.plan(request); };
  return first_plan(scenario, plan, interrupted);
}

}  // namespace slalom::sim
