#pragma once

#include "slalom/sim/loop_settings.hpp"

namespace slalom::sim {

/// What a planning cycle costs the loop in time, by the rule of the loop's settings (LatencyRule).
class Latency {
 public:
  /// Throws InvalidValue naming `loop.solve_times` when the rule is `recorded` and there are none.
  explicit Latency(const LoopSettings& settings);

  /// Time [s] from the start of cycle `index` >= 1 until its plan is there; `measured` [s] is what
  /// planning took by the wall clock. Zero by the rules `instant` and `paper`, by which no plan is
  /// late. By `recorded` and `model` it depends on `index` alone.
  double charge(int index, double measured) const;

  /// Whether lateness follows from the settings alone, so that a drive comes to the same bits
  /// however fast the machine is.
  bool scripted() const;

 private:
  const LoopSettings& settings_;
};

}  // namespace slalom::sim
