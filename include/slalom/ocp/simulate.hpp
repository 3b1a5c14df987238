#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// x' = f(t, x, u): what a simulation integrates, a problem's dynamics or another model.
struct System {
  using Rates = std::function<void(double t, std::span<const double> x, std::span<const double> u,
                                   std::span<double> rates)>;

  std::string name;                   ///< for messages
  std::vector<std::string> states;    ///< names, in the order of x
  std::vector<std::string> controls;  ///< names, in the order of u
  Rates rates;                        ///< sets x' [state's unit per time unit]
  std::vector<double> scales = {};    ///< typical sizes of the states; empty: all 1
};

/// A problem's dynamics. Everything they use besides states, controls and time comes from `fixed`:
/// t0, tf, static parameters, integrals and, if `fixed` has states, the first of them for
/// initial(). Anything that `fixed` lacks comes from the problem's guesses. Run-time parameters
/// have their present values. Throws InvalidValue for a state without dynamics, and for dynamics
/// that use final(), which a simulation cannot know.
System system_of(const Problem& problem, const Trajectory& fixed = {});

/// The controls of a simulation.
struct Controls {
  /// Controls at time t and states x, in the system's order.
  using Law = std::function<std::vector<double>(double t, std::span<const double> x)>;

  Law law;
  std::vector<double> corners = {};  ///< increasing times at which they may jump or bend
};

Controls constant_controls(std::vector<double> values);
Controls controls_of_time(std::function<std::vector<double>(double t)> law,
                          std::vector<double> corners = {});
/// A solution's own controls, by its scheme's polynomials; beyond its ends, those at the nearer
/// end.
Controls controls_of(const Problem& problem, const Solution& solution);

struct SimulateSettings {
  std::optional<double> t0 = {};  ///< if left out: a problem's guess; 0 for a system
  std::optional<double> tf = {};  ///< if left out: a problem's guess; 1 for a system
  int steps = 100;                ///< equal steps from point to point; corners are points too
  double tolerance = 1e-9;        ///< relative and, in units of each state's scale, absolute
  /// Polled during the simulation; once it is true, the simulation ends there, incomplete.
  std::function<bool()> stop = {};
};

/// A simulated trajectory. If a control jumps at a point, the point has the control after the jump.
struct Simulation {
  Trajectory trajectory;
  bool complete = false;  ///< it reached tf; otherwise tf and the points end where states were lost
  std::string message;    ///< one sentence on where and why; empty when complete
};

/// Integrates from x0 (Bulirsch & Stoer's extrapolation with adaptive order and steps; Hairer,
/// Norsett & Wanner 1993, section II.9) from corner to corner of the controls. Throws InvalidValue
/// for the wrong number of states or controls, numbers that are not finite, and t0 above tf.
[[nodiscard]] Simulation simulate(const System& system, const std::vector<double>& x0,
                                  const Controls& controls, const SimulateSettings& settings = {});
/// The same for a problem's own dynamics; static parameters are as the problem guesses them.
[[nodiscard]] Simulation simulate(const Problem& problem, const std::vector<double>& x0,
                                  const Controls& controls, const SimulateSettings& settings = {});

}  // namespace slalom::ocp
