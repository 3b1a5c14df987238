#pragma once

#include <vector>

#include "slalom/planner/plan.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::sim {

/// The controls a plant follows, over absolute time [s]: linear between knots, the first held
/// before the first knot and the last after the last (section 4 of docs/formulation.md).
class ControlSignal {
 public:
  /// Straight on at constant speed: steering rate and jerk zero for all time.
  ControlSignal() = default;
  /// The controls of a usable plan, from plan.t_start on. Throws Error when it is not usable.
  explicit ControlSignal(const planner::Plan& plan);

  /// A plan can be driven: it has nodes, one finite control for each, at finite times that do not
  /// decrease. Whether the solver calls it solved is another question.
  static bool usable(const planner::Plan& plan);

  /// The same signal, each knot `delay` [s] later.
  ControlSignal delayed(double delay) const;

  /// Control at absolute time t [s].
  vehicle::Control at(double t) const;
  /// Absolute times [s] of the knots, where the signal may have kinks; empty for straight on.
  const std::vector<double>& knots() const { return t_; }

 private:
  std::vector<double> t_;
  std::vector<vehicle::Control> control_;
};

}  // namespace slalom::sim
