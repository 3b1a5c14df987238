#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "slalom/nlp/problem.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// The multipliers of one constraint or of a variable's bounds, in user's units.
struct Multipliers {
  /// A constraint, "family[member]", or a variable with bounds: a state, control, slack, static
  /// parameter, integral, t0 or tf.
  std::string name;
  std::vector<std::size_t> points;  ///< of the mesh and scheme; empty if there is one value
  /// The decrease of the objective per unit that the bound is raised at that point alone: >= 0 at
  /// an upper bound, <= 0 at a lower one, 0 at neither.
  std::vector<double> values;
};

/// The excess of a soft constraint over its bounds and tolerance, one number for each point (for a
/// family, for each member at each point): > 0 above the upper bound, < 0 below the lower bound.
struct Excesses {
  std::string name;
  std::vector<std::size_t> points;
  std::vector<double> values;
};

/// The costates at the collocated points, which may differ on the two sides of a node.
struct CollocatedCostates {
  std::vector<double> tau;
  std::vector<std::vector<double>> values;  ///< [point][state], dJ*/dx
};

/// Data of a solution, besides its trajectory, for a start on another mesh.
struct Duals {
  std::vector<double> tau;  ///< of all points; Multipliers::points are indices into it
  CollocatedCostates costates;
  std::vector<Multipliers> multipliers;
};

struct Transcribed;

/// A problem made into a stage-structured NLP on a mesh by a collocation scheme.
///
/// Stage k holds node k (slacks of that end, states, controls) and the interior points of interval
/// k. A control that the scheme leaves out, such as the last one of LGR, is held from the point
/// next to it. The globals are t0, tf, static parameters and one copy of every end value that a
/// function at another point uses (a lifted value; an equation at its own stage ties it to the
/// copy). Everything nonlinear is evaluated in batches: one pass over all points for each function.
class Transcription final : public nlp::Problem {
 public:
  /// Throws InvalidValue for mistakes that no single declaration shows: a state without dynamics,
  /// no states, a function of a foreign symbol, no tf after t0, a constraint that no variable can
  /// change.
  Transcription(const ocp::Problem& problem, const Mesh& mesh, const Schemes& schemes);
  ~Transcription() override;

  /// Takes over changed run-time parameters, family numbers, guesses and bounds. The problem must
  /// be the transcribed one, with the same enabled constraints and numbers of members; throws
  /// InvalidValue otherwise.
  void update(const ocp::Problem& problem);

  /// The primal start for a guess; end slacks are the problem's when the guess has none.
  std::vector<double> point(const Trajectory& guess) const;
  /// A guess of straight lines between the bounds given at both ends (or the bounds' middle).
  Trajectory straight_guess() const;
  Trajectory trajectory(std::span<const double> x) const;
  /// Cost terms by name at x; they sum to the objective.
  std::vector<std::pair<std::string, double>> cost_terms(std::span<const double> x);
  /// The same at the point whose values were evaluated last.
  std::vector<std::pair<std::string, double>> last_cost_terms() const;

  /// Costates at the mesh nodes, [node][state]: dJ*/dx, user's units. The Lagrangian is f + y' g
  /// with defects x_(k+1) - x_k - ..., so within an interval, minus the defects' y estimates the
  /// costate. At a node it is the mean of two numbers: the derivative of the terms after the node
  /// (its interval's quadrature and defects), and minus the derivative of the terms before. The two
  /// differ by active rows at the node.
  std::vector<std::vector<double>> costates(std::span<const double> x, std::span<const double> y);
  CollocatedCostates collocated_costates(std::span<const double> y) const;
  /// A warm start: the guess's point, and multipliers with the costates and the densities over time
  /// of `duals`.
  nlp::Start carried(const Trajectory& guess, const Duals& duals);
  /// Of all enabled constraints and of all variables with bounds, by name.
  std::vector<Multipliers> multipliers(const nlp::Start& point) const;
  std::vector<Excesses> excesses(std::span<const double> x) const;
  /// Row of the last defect of a state in an interval.
  std::size_t defect_row(std::size_t state, std::size_t interval) const;

  /// The variable behind an end value, t0, tf, a static parameter or an integral; none for any
  /// other symbol.
  std::optional<std::size_t> end_variable(const Expr& symbol) const;

  /// For each variable, whether it is anything but the excess of a soft row.
  std::vector<char> regular_variables() const;

  const nlp::Structure& structure() const override;
  const nlp::Limits& limits() const override;
  nlp::Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y,
                      nlp::Parts parts, nlp::Evaluation& out) override;
  std::string variable_name(std::size_t index) const override;
  std::string row_name(std::size_t index) const override;
  std::optional<nlp::Formulas> formulas() const override;

 private:
  friend const Transcribed& transcribed_by(const Transcription& transcription);
  void relax_constant_rows();

  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::ocp
