#pragma once

#include <vector>

#include "slalom/vehicle/state.hpp"

namespace slalom::vehicle {

/// The controls a plant follows, over absolute time [s]: linear between knots, the first held
/// before the first knot and the last after the last (section 4 of docs/formulation.md).
class ControlSignal {
 public:
  /// Straight on at constant speed: steering rate and jerk zero for all time.
  ControlSignal() = default;
  /// `controls` at the absolute times `t` [s]. Throws Error when they are not usable.
  ControlSignal(std::vector<double> t, std::vector<Control> controls);

  /// Can be driven: there are knots, one finite control for each, at finite times that do not
  /// decrease.
  static bool usable(const std::vector<double>& t, const std::vector<Control>& controls);

  /// The same signal, each knot `delay` [s] later.
  ControlSignal delayed(double delay) const;

  /// Control at absolute time t [s].
  Control at(double t) const;
  /// Absolute times [s] of the knots, where the signal may have kinks; empty for straight on.
  const std::vector<double>& knots() const { return t_; }

 private:
  std::vector<double> t_;
  std::vector<Control> control_;
};

}  // namespace slalom::vehicle
