#pragma once

#include <array>
#include <span>

#include "slalom/expr/expr.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::vehicle {

/// The 3DoF dynamic vehicle as expressions: what OCP, prediction and plant all evaluate.
struct Model {
  std::array<expr::Expr, kStates> state;       ///< symbols
  std::array<expr::Expr, kControls> control;   ///< symbols
  std::array<expr::Expr, kStates> derivative;  ///< state'
  expr::Expr Fyf, Fyr;                         ///< lateral axle forces [N], left positive
  /// Linear part of the tyre forces, cornering stiffness times slip angle [N].
  expr::Expr Fyf_linear, Fyr_linear;
  expr::Expr alpha_f, alpha_r;                  ///< slip angles as in section 2 [rad]
  std::array<expr::Expr, kWheels> wheel_loads;  ///< rl, rr, fl, fr [N]
  expr::Expr ax_min, ax_max;                    ///< acceleration limits at ux [m/s^2]
};

/// Builds the model of `parameters` (sections 1 and 2 of docs/formulation.md; the paper's Eqn. 6).
Model make_model(const Parameters& parameters);

/// The model compiled for numbers: one state at a time. SI units, frame and signs as in state.hpp.
/// Thread-safe after construction; copies share the compiled code. Outside the model's domain
/// (ux = -EP, loads that leave the tyre formula's range) results may be NaN, never an exception.
class Dynamics {
 public:
  explicit Dynamics(const Parameters& parameters);
  /// Time derivative of the state [state's units per s]; section 1 of docs/formulation.md.
  State derivative(const State& state, const Control& control) const;
  /// Vertical wheel loads [N], rl, rr, fl, fr; section 2.
  WheelLoads wheel_loads(const State& state) const;
  /// Lateral axle forces [N], front then rear, left positive; section 2.
  std::array<double, 2> tyre_forces(const State& state) const;

 private:
  expr::Function derivative_, loads_, forces_;
};

}  // namespace slalom::vehicle
