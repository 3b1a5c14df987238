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

/// The numbers of a problem's statement by which an answer has sensitivities, by name, with what
/// they are now:
///
///   "mass"                             a run-time parameter
///   "initial x", "final x", "t0", "tf" a state fixed at an end, an end of the horizon that is
///   fixed "lower x", "upper x"               bounds of a state, control, static parameter, slack
///   or
///                                      integral, of "initial x", "final x", "t0" and "tf", or of a
///                                      constraint; by the name alone where both are equal
///   "disc[one].a"                      a number of a family's member (at all points alike)
///   "weight of wall"                   the weight of a soft constraint
///
/// Those of what is switched off, and infinite bounds, are not among them.
std::vector<std::pair<std::string, double>> sensitivity_numbers(const Problem& problem);
/// The same of phases, as "phase: name". A parameter's own name is that parameter in every phase
/// that has one, and a link's its bound ("lower ...", "upper ..." where these differ).
std::vector<std::pair<std::string, double>> sensitivity_numbers(const PhasedProblem& problem);

/// How an answer moves with one number p: the derivative by p of everything in it, in the user's
/// units over the number's.
struct Sensitivity {
  std::string number;  ///< p
  /// Of the objective. Without a floor it is that of the Lagrangian with all else held, but for
  /// what is left of the barrier (envelope theorem; Fiacco 1983, section 3.4).
  double objective = 0;
  /// Of t0, tf, states and controls by point, static parameters, slacks and integrals. The points
  /// stay at their tau: at a fixed time, a state's derivative is that less its rate times the
  /// derivative of the point's time.
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
/// each number takes one more solve with its factors (nlp::Sensitivities has equations and
/// sources). Any back end's answer will do. They are those of the discretised problem, exact for
/// it: of the central point at a floor, of the active set without one.
class Sensitivities {
 public:
  /// `problem` is the one that was solved, with the numbers that it had. Throws InvalidValue for an
  /// answer that is not solved or is one of other numbers, and where it has no sensitivities since
  /// the KKT matrix is singular or the answer no strict minimum, with what is not determined.
  Sensitivities(const Problem& problem, const Solution& solution);
  ~Sensitivities();
  Sensitivities(Sensitivities&&) noexcept;
  Sensitivities& operator=(Sensitivities&&) noexcept;

  /// By one of sensitivity_numbers(). Throws InvalidValue for another name, naming the nearest; for
  /// "t0" and "tf" where a row, a cost term or a breakpoint stands at a time, since the mesh would
  /// have to move; and where the derivative is not finite.
  Sensitivity operator()(const std::string& number) const;

  /// The answer to `changed`, the problem with other numbers (parameters, ends, times, members,
  /// weights, bounds of variables), to first order in all their changes together, as a Solution:
  /// judged as an answer to `changed`, so that its residuals say how good it is, `solved` where
  /// they are within the tolerances and else of status iteration_limit after no iterations. A guess
  /// or warm start for solving `changed` (Zavala & Biegler, Automatica 45, 2009, use it to act
  /// before that is done). Throws InvalidValue where more than numbers differ, and as above.
  [[nodiscard]] Solution predict(const Problem& changed) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A problem with some of its sensitivity_numbers() changed, by name. Throws InvalidValue for
/// another name, naming the nearest, and for bounds over the horizon and of constraints, which
/// stand where they are declared.
Problem with_numbers(Problem problem, const std::vector<std::pair<std::string, double>>& changes);

/// The same of phases: "first: initial x", "mass" of all that have one. Bounds of links stand where
/// they are declared.
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

/// The same of phases.
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
