#pragma once

#include <functional>
#include <optional>

#include "slalom/planner/planner.hpp"
#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::sim {

/// Hooks into a running drive.
struct LoopHooks {
  /// After each cycle, the warm-up solve (index 0) included.
  std::function<void(const Cycle&)> on_cycle;
  /// Polled at every cycle, sample and solver iteration; true ends the drive as interrupted.
  std::function<bool()> interrupted;
  /// If `take` is set: which solves of the scenario's own planner to record. Called before
  /// on_cycle.
  planner::Recorder record;
};

/// One planning call; planner::Planner in earnest, anything in tests.
using PlanFunction = std::function<planner::Plan(const planner::Request&)>;

/// Drives `scenario` in closed loop with its own planner (section 4 of docs/formulation.md). Throws
/// InvalidValue when check(scenario) does; how a drive fails is its outcome, never an exception.
/// A plant whose state leaves the model's domain while no solved plan is left counts as
/// not_optimal.
Drive drive(const Scenario& scenario, const LoopHooks& hooks = {});

/// The same with any planning function. Its first call is the warm-up solve if the scenario says
/// so; then one call a cycle.
Drive drive(const Scenario& scenario, const PlanFunction& plan, const LoopHooks& hooks = {});

/// The first cycle of a drive, not driven, and the warm-up solve before it.
struct FirstPlan {
  std::optional<Cycle> warm_up;  ///< none if the scenario wants none
  std::optional<Cycle> cycle;    ///< none if interrupted before it
};

/// Plans as drive() does in its first cycle, to the same bits, and does not drive; throws likewise.
/// `interrupted` is polled before each solve and in its iterations.
FirstPlan first_plan(const Scenario& scenario, const std::function<bool()>& interrupted = {});
/// The same with any planning function.
FirstPlan first_plan(const Scenario& scenario, const PlanFunction& plan,
                     const std::function<bool()>& interrupted = {});

}  // namespace slalom::sim
