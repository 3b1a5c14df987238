#pragma once

#include <functional>
#include <optional>

#include "rehearsal.hpp"
#include "slalom/sim/actuator.hpp"
#include "slalom/sim/closed_loop.hpp"
#include "slalom/sim/sensing.hpp"
#include "slalom/vehicle/control_signal.hpp"
#include "slalom/vehicle/plant.hpp"
#include "timing.hpp"

namespace slalom::sim {

/// check(scenario) by the scenario's own name.
void check(const Scenario& scenario);

/// The half of a cycle that knows only what is believed: sense, predict, plan.
class Planning {
 public:
  /// The plant's true state at a time [s] that is past or present.
  using History = std::function<vehicle::State(double)>;

  /// All it is given outlives it. `interrupted` may be empty.
  Planning(const Scenario& scenario, const Timing& timing, const PlanFunction& plan,
           const std::function<bool()>& interrupted);

  /// Cycle `index`, which begins at t0 [s] with what `actuator` was commanded under way. Its charge
  /// and its swap are left to Timing::settle.
  /// `last_was_late`: the plan of the cycle before.
  Cycle cycle(int index, double t0, const History& history, const Actuator& actuator,
              bool last_was_late);
  /// Where a plant that is the vehicle believed in gets from `state` at t0 to t1 on `signal`, if
  /// the last cycle predicted just that.
  std::optional<vehicle::State> foreseen(const vehicle::State& state,
                                         const vehicle::ControlSignal& signal, double t0,
                                         double t1) {
    return rehearsal_.end_of(state, signal, t0, t1);
  }
  /// How long after it is commanded a plan acts, as far as the planner knows [s].
  double known_actuator_delay() const;
  /// The same from the scenario's start.
  Cycle first_cycle(int index);
  /// The first OCP as cycle 0, before the clock starts; none if the scenario wants none.
  std::optional<Cycle> warm_up();

  bool interrupted() const { return interrupted_ && interrupted_(); }

 private:
  planner::Request request(const Cycle& cycle, bool last_was_late) const;
  vehicle::State predicted(const vehicle::State& measured, double t0, const Actuator& actuator);

  const Scenario& scenario_;
  const Timing& timing_;
  const PlanFunction& plan_;
  const std::function<bool()>& interrupted_;
  vehicle::Plant believed_;  ///< what prediction takes the plant for
  Rehearsal rehearsal_;
  Sensors sensors_;
};

}  // namespace slalom::sim
