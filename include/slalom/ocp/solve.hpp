#pragma once

#include <string>
#include <utility>
#include <vector>

#include "slalom/nlp/check.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/trajectory.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

struct Solution;

/// How far one constraint or bound of an infeasible problem would have to move, with all others
/// unchanged, for the violation to vanish to first order.
struct Conflict {
  std::string name;   ///< of a constraint, link or variable; "initial x", "final x" of fixed ends
  double change = 0;  ///< of its bound [its unit]: > 0 upwards, < 0 downwards, 0 not known
};

/// An equation along the horizon in which controls appear only after differentiation.
struct HighIndex {
  std::string name;  ///< of the constraint
  int index = 3;     ///< that derivative's order plus 1, as for a differential-algebraic equation
};

/// How to solve a problem; the defaults suit a smooth one.
struct SolveSettings {
  Mesh mesh = Mesh::uniform(40);
  Schemes scheme = hermite_simpson();
  nlp::Options options = {};   ///< tol, floor, limits, ...
  std::string backend = {};    ///< of nlp::make_solver; empty: the default one
  Trajectory guess = {};       ///< empty: straight lines between the bounds at both ends
  nlp::Start warm_start = {};  ///< a Solution's `point` on the same mesh and scheme; beats guess
  /// A solution on any mesh and scheme, whose trajectory and multipliers are carried to this mesh;
  /// beats the guess. With `warm_start` too, that is taken if it has the sizes of this problem's
  /// NLP. It must outlive the call.
  const Solution* previous = nullptr;
};

/// An answer, in the user's units. `solved()` needs the agreement of the independent check.
struct Solution {
  nlp::Status status = nlp::Status::numerical_failure;
  nlp::Fault fault;  ///< for Status::invalid_number
  double objective = 0;
  std::vector<std::pair<std::string, double>> cost_terms;  ///< they sum to the objective
  Trajectory trajectory;
  Mesh mesh = Mesh::uniform(1);  ///< mesh and scheme are those of `trajectory`
  Schemes scheme = trapezoidal();
  /// dJ*/dx at the mesh nodes, [node][state]: positive if more of a state costs more. Computed from
  /// the defects' multipliers; at least of second order where no path row is active.
  std::vector<std::vector<double>> costates;
  CollocatedCostates collocated_costates;
  std::vector<Multipliers> multipliers;  ///< of constraints and bounds, by name
  std::vector<Excesses> excesses;        ///< of soft constraints, by name
  /// Tables (expr::cubic_spline) that are used beyond their knots, where they continue as a line:
  /// the term, such as "dynamics of v", and the greatest distance beyond [unit of the table's x].
  std::vector<std::pair<std::string, double>> beyond_tables;
  nlp::Residuals residuals;  ///< recomputed from the point; names the worst constraint
  /// For an infeasible problem or one with too few freedoms, as interior_point finds them: the
  /// items that contradict each other, beginning with the item that would have to move least in its
  /// own scale.
  std::vector<Conflict> conflicts;
  /// For an answer that is not solved, or that no mesh refines: equations that Newton's method can
  /// seldom solve as stated. Instead, require the derivative in which a control appears, and at t0
  /// the equation and its lower derivatives (Gear & Petzold, SIAM J. Numer. Anal. 21, 1984).
  std::vector<HighIndex> high_index;
  /// For an answer that is not solved: cost terms with kinks, at which Newton's method can jump to
  /// and fro. smooth_kinks() states the same cost without them.
  std::vector<std::string> kinks;
  nlp::Options options;  ///< of the solve
  std::string backend;   ///< of the solve, with its factorisation
  nlp::Start point;      ///< of the NLP, for warm starts
  int iterations = 0;
  double wall_s = 0;

  [[nodiscard]] bool solved() const {
    return status == nlp::Status::solved && residuals.solved(options);
  }
  double tf() const { return trajectory.tf; }
  std::vector<double> time() const;  ///< of each point

  // One number for each point; an unknown name throws InvalidValue, which names the nearest.
  std::vector<double> state(const std::string& name) const;
  std::vector<double> control(const std::string& name) const;
  double static_parameter(const std::string& name) const;
  double slack(const std::string& name) const;
  double cost_term(const std::string& name) const;
  std::vector<double> costate(const std::string& state_name) const;  ///< one for each mesh node
  const Multipliers& multiplier(const std::string& name) const;
  const Excesses& excess(const std::string& name) const;

  std::vector<double> state_units;  ///< the scales of the states in the solve
  /// All scales of the solve, given or found: of variables, t0 and tf, then constraints.
  std::vector<std::pair<std::string, double>> scales;
  std::vector<std::string> state_names, control_names, static_parameter_names, slack_names;
};

/// Transcribes, solves and checks. Throws InvalidValue for set-up errors only; how the solve ended
/// is in the Solution.
[[nodiscard]] Solution solve(const Problem& problem, const SolveSettings& settings = {});

struct PhasedSolution;

/// How to solve a phased problem; lists have one entry for each phase, or are empty for defaults.
struct PhasedSettings {
  std::vector<PhasedTranscription::Grid> grids = {};
  nlp::Options options = {};
  std::string backend = {};
  std::vector<Trajectory> guesses = {};
  nlp::Start warm_start = {};  ///< a PhasedSolution's `point` on the same grids; beats guesses
  const PhasedSolution* previous = nullptr;  ///< as SolveSettings::previous
};

/// An answer to a phased problem.
struct PhasedSolution {
  nlp::Status status = nlp::Status::numerical_failure;
  nlp::Fault fault;
  double objective = 0;
  std::vector<Solution> phases;  ///< each with its own share of the objective
  std::vector<std::pair<std::string, double>>
      cost_terms;  ///< of the problem itself, not of a phase
  /// For each link: the decrease of J* per unit that its bound is raised: >= 0 at an upper bound,
  /// <= 0 at a lower one.
  std::vector<std::pair<std::string, double>> link_multipliers;
  nlp::Residuals residuals;
  std::vector<Conflict> conflicts;  ///< as Solution::conflicts, of phases "phase: name"
  nlp::Options options;
  std::string backend;
  nlp::Start point;  ///< in user's units
  int iterations = 0;
  double wall_s = 0;

  [[nodiscard]] bool solved() const {
    return status == nlp::Status::solved && residuals.solved(options);
  }
};

[[nodiscard]] PhasedSolution solve(const PhasedProblem& problem,
                                   const PhasedSettings& settings = {});

}  // namespace slalom::ocp
