#pragma once

#include <vector>

#include "slalom/base/error.hpp"
#include "slalom/vehicle/control_signal.hpp"
#include "slalom/vehicle/model.hpp"
#include "slalom/vehicle/parameters.hpp"

namespace slalom::vehicle {

/// The plant's equations could not be integrated further: the state left the model's domain.
class PlantError : public Error {
 public:
  using Error::Error;
};

/// The vehicle as driven: the 3DoF model with Pacejka tyres, integrated by an adaptive
/// Runge–Kutta–Fehlberg method of order 8(7), and from below 1 m/s, where the tyres make it stiff,
/// by an extrapolated linearly implicit Euler method of order 7. Prediction is a plant too, of the
/// vehicle believed in. SI units, state and frame as in vehicle/state.hpp. Thread-safe.
class Plant {
 public:
  /// Relative and absolute `tolerance` of each step; instants at most `sample_step` [s] apart.
  Plant(const Parameters& vehicle, double tolerance, double sample_step);

  /// The state at t1 from that at t0 [s], while the control goes linearly from signal.at(t0) to
  /// signal.at(t1): exact for a signal without a knot in between. The integrator works on the
  /// displacement from (x, y) at t0, so a drive does not depend on where the origin lies.
  /// Throws PlantError.
  State advance(const State& state, const ControlSignal& signal, double t0, double t1) const;

  /// The same while the control goes linearly from `first` to `last`.
  State advance(const State& state, const Control& first, const Control& last, double t0,
                double t1) const;

  /// The instants (t0, t1] at which a drive on `signal` is sampled: every knot, t1 itself, and an
  /// instant kSwapGap before it, equally spaced in between. The signal is linear between them.
  std::vector<double> instants(const ControlSignal& signal, double t0, double t1) const;

  /// State prediction: the state at t1, advanced from instant to instant as the drive will be.
  /// Throws PlantError.
  State predict(State state, const ControlSignal& signal, double t0, double t1) const;

  const Dynamics& dynamics() const { return dynamics_; }

  /// A sample stands this long [s] before each end of an execution horizon, where the control may
  /// jump: linear interpolation of a drive's samples then gives back the control that was driven.
  static constexpr double kSwapGap = 1e-9;

 private:
  Dynamics dynamics_;
  double tolerance_, sample_step_;
};

}  // namespace slalom::vehicle
