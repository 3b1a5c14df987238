#pragma once

#include <string>

#include "slalom/planner/task.hpp"
#include "slalom/sim/loop_settings.hpp"
#include "slalom/sim/plant_settings.hpp"
#include "slalom/sim/sensing.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::sim {

/// Everything a drive needs: a planner's task, a start, and the loop around them. Obstacles are
/// what they are; `vehicle` is what the planner believes, and what is driven but for `plant`.
struct Scenario : planner::Task {
  std::string name;
  std::string title;
  vehicle::State start = {0, 0, 0, 0, 1.5707963267948966, 0, 17, 0};
  LoopSettings loop;
  PlantSettings plant;
  SensingSettings sensing;
  /// The file did not state loop.sm_crash: changes of vehicle.footprint change it. Who sets it
  /// later sets this to false.
  bool sm_crash_follows = false;
};

/// Throws InvalidValue for a value outside its registered range and for contradictions no single
/// option shows: start outside its bounds or inside a grown obstacle, tex above tf_max, L_range <=
/// kappa. `where` names the file; keys count from the scenario ("goal.sigma", "obstacles.O2.a").
void check(const Scenario& scenario, const std::string& where);

}  // namespace slalom::sim
