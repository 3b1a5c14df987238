#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// The numbers of a problem for which an answer has sensitivities, by name, with their present
/// values:
///
///   "mass"                  a run-time parameter
///   "initial x", "final x"  a state fixed at an end
///   "t0", "tf"              a fixed end of the horizon
///   "lower x", "upper x"    bounds of a state, control, static parameter, slack, integral or
///                           constraint, or of "initial x", "final x", "t0" and "tf"; only the
///                           name if both bounds are equal
///   "disc[one].a"           a number of a family's member (the same at all points)
///   "weight of wall"        the weight of a soft constraint
///
/// Numbers of disabled items, and infinite bounds, are left out.
std::vector<std::pair<std::string, double>> sensitivity_numbers(const Problem& problem);
/// The same for phases, as "phase: name". A parameter's name alone is that parameter in every phase
/// that has it, and a link's name is its bound ("lower ...", "upper ..." if these differ).
std::vector<std::pair<std::string, double>> sensitivity_numbers(const PhasedProblem& problem);

/// How an answer changes with one number p: the derivative of everything in it with respect to p,
/// in the user's units over the unit of p.
struct Sensitivity {
  std::string number;  ///< name of p
  /// Derivative of the objective. Without a floor it is that of the Lagrangian with everything else
  /// held, except for the remaining barrier (envelope theorem; Fiacco 1983, section 3.4).
  double objective = 0;
  /// Derivatives of t0, tf, states and controls by point, static parameters, slacks and integrals.
  /// The points stay at their tau: for the derivative at a fixed time, subtract the state's rate
  /// times the derivative of the point's time.
  Trajectory trajectory;
  std::vector<Multipliers> multipliers;  ///< of constraints and bounds, by name
  nlp::Start point;                      ///< of the NLP's variables and multipliers

  double tf() const { return trajectory.tf; }
  // One number for each point; an unknown name throws InvalidValue, which names the nearest.
  std::vector<double> state(const std::string& name) const;
  std::vector<double> control(const std::string& name) const;
  double static_parameter(const std::string& name) const;
  double slack(const std::string& name) const;
  double integral(const std::string& name) const;
  const Multipliers& multiplier(const std::string& name) const;

  std::vector<std::string> state_names, control_names, static_parameter_names, slack_names,
      integral_names;
};

/// Parametric sensitivities of an answer: the KKT matrix is factorised once, at the answer, and
/// each number takes one more solve with the factors (nlp::Sensitivities has equations and
/// sources). The answer may come from any back end. The sensitivities are exact for the discretised
/// problem: those of the central point at a floor, those of the active set without a floor.
class Sensitivities {
 public:
  /// `problem` is the solved problem with its numbers. Throws InvalidValue for an answer that is
  /// not solved or belongs to other numbers. Also throws if there are no sensitivities, since the
  /// KKT matrix is singular or the answer is not a strict minimum; the message names what is not
  /// determined.
  Sensitivities(const Problem& problem, const Solution& solution);
  ~Sensitivities();
  Sensitivities(Sensitivities&&) noexcept;
  Sensitivities& operator=(Sensitivities&&) noexcept;

  /// The sensitivity to one of sensitivity_numbers(). Throws InvalidValue for another name, naming
  /// the nearest; for "t0" and "tf" if a row, a cost term or a breakpoint is at a fixed time, since
  /// the mesh would have to move; and if the derivative is not finite.
  Sensitivity operator()(const std::string& number) const;

  /// A first-order answer to `changed`, the problem with other numbers (parameters, ends, times,
  /// members, weights, bounds of variables), for all changes together. It is judged as an answer to
  /// `changed`, so its residuals show how good it is: its status is `solved` if they are within the
  /// tolerances, else iteration_limit after no iterations. Use it as a guess or warm start for
  /// solving `changed` (Zavala & Biegler, Automatica 45, 2009, act on it before that solve ends).
  /// Throws InvalidValue if more than numbers differ, and as above.
  [[nodiscard]] Solution predict(const Problem& changed) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A problem with some of its sensitivity_numbers() changed, by name. Throws InvalidValue for
/// another name, naming the nearest, and for bounds over the horizon and of constraints, which only
/// their declarations set.
Problem with_numbers(Problem problem, const std::vector<std::pair<std::string, double>>& changes);

/// The same for phases: "first: initial x", or "mass" of all phases that have it. Only their
/// declarations set the bounds of links.
PhasedProblem with_numbers(PhasedProblem problem,
                           const std::vector<std::pair<std::string, double>>& changes);

/// Sensitivity of an answer to a phased problem.
struct PhasedSensitivity {
  std::string number;
  double objective = 0;
  std::vector<Sensitivity> phases;  ///< each with its own share of the objective
  std::vector<std::pair<std::string, double>> link_multipliers;
  nlp::Start point;
};

/// The same for phases.
class PhasedSensitivities {
 public:
  PhasedSensitivities(const PhasedProblem& problem, const PhasedSolution& solution);
  ~PhasedSensitivities();
  PhasedSensitivities(PhasedSensitivities&&) noexcept;
  PhasedSensitivities& operator=(PhasedSensitivities&&) noexcept;

  PhasedSensitivity operator()(const std::string& number) const;
  /// As Sensitivities::predict: for phases replaced by the same ones with other numbers.
  [[nodiscard]] PhasedSolution predict(const PhasedProblem& changed) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::ocp
