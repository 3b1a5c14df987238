#pragma once

#include "slalom/sim/drive.hpp"
#include "slalom/sim/latency.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::sim {

/// When cycles begin, for when they plan, when their plans take effect and what they are charged,
/// by the scenario's rules of latency and deadline; nothing else in the loop asks which rule it is.
/// Cycles begin tex apart, and anew from the time at which a late plan is there.
class Timing {
 public:
  /// For a planner of this method. `settings` outlive it. Throws as Latency does.
  explicit Timing(const LoopSettings& settings,
                  planner::Method method = planner::Method::receding_horizon);

  /// Whether the plant stands still until the plan is there, which then takes effect at t0. If not,
  /// the old signal runs on while the cycle plans, and the plan takes effect at its end.
  bool plant_waits() const { return settings_.latency == LatencyRule::instant; }
  /// When the plan of a cycle that begins at t0 begins [s]: from the state measured, if that is t0
  /// itself, from the one predicted if it is later.
  double plan_start(double t0) const { return plant_waits() ? t0 : t0 + settings_.tex; }
  /// What the planner may take of this thread's time [s]. A scripted rule holds the deadline
  /// against the time charged instead.
  double time_limit() const;
  /// And by the wall clock, where that is what is charged [s].
  double clock_limit() const;

  /// When the next cycle begins, and the one before ends [s].
  double next_cycle() const { return grid_ + horizons_ * settings_.tex; }
  /// Ends the cycle that began at next_cycle(): settles its charge and the time of its swap. By a
  /// scripted rule its solve time is the charge, and a plan that misses the deadline is void. A
  /// late plan of a planner that verifies is no longer the one that was verified: the last one goes
  /// on.
  void settle(Cycle& cycle);

 private:
  const LoopSettings& settings_;
  Latency latency_;
  bool deadline_;     ///< planning ends within tex
  bool verifies_;     ///< the planner does
  double grid_ = 0;   ///< cycles begin at grid + k tex [s]
  int horizons_ = 0;  ///< k of the next one
};

}  // namespace slalom::sim
