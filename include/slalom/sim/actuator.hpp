#pragma once

#include <vector>

#include "slalom/vehicle/control_signal.hpp"

namespace slalom::sim {

/// The way from commanded controls to those the plant drives: a pure delay, the plant at t drives
/// what was commanded for t - delay. Times are absolute [s].
class Actuator {
 public:
  explicit Actuator(double delay) : delay_(delay) {}

  /// From t on, `signal` is commanded. Calls come in the order of time.
  void command(vehicle::ControlSignal signal, double t);
  /// What is commanded now; straight on at constant speed before the first command.
  const vehicle::ControlSignal& commanded() const { return commanded_; }

  /// What the plant drives from t on, until the next change.
  const vehicle::ControlSignal& driven(double t) const;
  /// The first time after t at which the plant goes over to another signal that is commanded
  /// already; infinity if there is none.
  double next_change(double t) const;

 private:
  struct Driven {
    double from;
    vehicle::ControlSignal signal;
  };
  /// Of the last one in force at t, counted from 1; 0: straight on.
  std::size_t in_force(double t) const;

  double delay_;
  vehicle::ControlSignal commanded_, straight_on_;
  std::vector<Driven> driven_;  ///< all there were, in the order of time
};

}  // namespace slalom::sim
