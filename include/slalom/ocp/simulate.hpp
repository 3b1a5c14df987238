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

/// A problem's dynamics. What they use beside states, controls and time is as in `fixed`: t0, tf,
/// static parameters, integrals (those that it has not: as the problem guesses them) and, where it
/// has states, their first ones for initial(). Run-time parameters are taken as they are now.
/// Throws InvalidValue for a state without dynamics and for dynamics that use final(): a simulation
/// cannot know it.
System system_of(const Problem& problem, const Trajectory& fixed = {});

/// What drives a simulation.
struct Controls {
  /// Controls at time t and states x, in the system's order.
  using Law = std::function<std::vector<double>(double t, std::span<const double> x)>;

  Law law;
  std::vector<double> corners = {};  ///< increasing times at which they may jump or bend
};

Controls constant_controls(std::vector<double> values);
Controls controls_of_time(std::function<std::vector<double>(double t)> law,
                          std::vector<double> corners = {});
/// A solution's own, by its scheme's polynomials; beyond its ends the nearer end's.
Controls controls_of(const Problem& problem, const Solution& solution);

struct SimulateSettings {
  std::optional<double> t0 = {};  ///< of a problem its guess if left out; of a system 0
  std::optional<double> tf = {};  ///< likewise; of a system 1
  int steps = 100;                ///< equal steps between the points; corners are points too
  double tolerance = 1e-9;        ///< absolute, in units of each state's scale, and relative
};

/// A simulated trajectory. Where a control jumps, a point has the one that follows.
struct Simulation {
  Trajectory trajectory;
  bool complete = false;  ///< to tf; else the points end, and tf is, where the states were lost
  std::string message;    ///< one sentence on where; empty when complete
};

/// Integrates from x0 (Bulirsch & Stoer's extrapolation with adaptive order and steps; Hairer,
/// Norsett & Wanner 1993, section II.9) from corner to corner of the controls. Throws InvalidValue
/// for numbers of states or controls that do not match, numbers not finite, and t0 above tf.
[[nodiscard]] Simulation simulate(const System& system, const std::vector<double>& x0,
                                  const Controls& controls, const SimulateSettings& settings = {});
/// The same of a problem's own dynamics; the trajectory has its static parameters' guesses.
[[nodiscard]] Simulation simulate(const Problem& problem, const std::vector<double>& x0,
                                  const Controls& controls, const SimulateSettings& settings = {});

}  // namespace slalom::ocp
