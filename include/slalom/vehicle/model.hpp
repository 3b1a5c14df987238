#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "slalom/expr/expr.hpp"
#include "slalom/expr/function.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::vehicle {

/// The models of a vehicle. `pacejka` is the 3DoF vehicle of sections 1 and 2 of
/// docs/formulation.md; plant and prediction always use it. The others are for planners:
/// `linear_tyre` has tyre forces linear in the slip angle, `constant_speed` is the 3DoF vehicle at
/// a speed that does not change, `kinematic` is a bicycle whose wheels do not slip.
enum class ModelKind { pacejka, linear_tyre, constant_speed, kinematic };

/// What an entry of the state is in a model: a state with a derivative of its own, a number held
/// over the horizon, or a function of the states.
enum class Role { state, held, derived };

/// A vehicle as expressions, which OCP, prediction and plant evaluate.
struct Model {
  std::array<expr::Expr, kStates> state;       ///< symbols
  std::array<expr::Expr, kControls> control;   ///< symbols
  std::array<expr::Expr, kStates> derivative;  ///< state'; 0 for entries held or derived
  std::array<Role, kStates> role{};            ///< what each entry of the state is
  std::array<expr::Expr, kStates> value;       ///< of derived entries, in the states' symbols
  std::array<bool, kControls> used{};          ///< controls that the model lacks are zero
  /// Lateral axle forces [N], left positive; a kinematic model has none.
  expr::Expr Fyf, Fyr;
  /// Linear part of the tyre forces, cornering stiffness times slip angle [N]; again none if
  /// kinematic.
  expr::Expr Fyf_linear, Fyr_linear;
  expr::Expr alpha_f, alpha_r;                  ///< slip angles as in section 2 [rad]
  std::array<expr::Expr, kWheels> wheel_loads;  ///< rl, rr, fl, fr [N]
  expr::Expr ax_min, ax_max;                    ///< acceleration limits at ux [m/s^2]
};

/// Builds a model of `parameters` (sections 1 and 2 of docs/formulation.md; the paper's Eqn. 6;
/// docs/planner-models.md). Wheel loads are those of the accelerations the model itself has.
Model make_model(const Parameters& parameters, ModelKind kind = ModelKind::pacejka);

/// Names of the kinds, in the enum's order, as files have them.
const std::vector<std::string>& model_names();

/// The model compiled for numbers: one state at a time. SI units, frame and signs as in state.hpp.
/// Thread-safe after construction; copies share the compiled code. Outside the model's domain
/// (ux = -EP, loads that leave the tyre formula's range) results may be NaN, never an exception.
class Dynamics {
 public:
  explicit Dynamics(const Parameters& parameters);
  /// Time derivative of the state [state's units per s]; section 1 of docs/formulation.md.
  State derivative(const State& state, const Control& control) const;
  /// Its derivatives by the states: row i is that of the i-th state's.
  std::array<State, kStates> jacobian(const State& state, const Control& control) const;
  /// The same as a function of the states and then the controls, with its derivatives, for many
  /// points at once.
  const expr::Function& derivative_function() const { return derivative_; }
  /// Vertical wheel loads [N], rl, rr, fl, fr; section 2.
  WheelLoads wheel_loads(const State& state) const;
  /// Lateral axle forces [N], front then rear, left positive; section 2.
  std::array<double, 2> tyre_forces(const State& state) const;

 private:
  expr::Function derivative_, loads_, forces_;
};

}  // namespace slalom::vehicle
