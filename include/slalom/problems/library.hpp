#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::problems {

/// What a problem exercises. The tags before `phases` say what makes it hard.
enum class Tag {
  singular_arc,           ///< a control that the Hamiltonian does not determine
  state_constraint,       ///< an active constraint on states, of first order
  high_order_constraint,  ///< an active constraint on states, of second order or more
  stiff,                  ///< time scales far apart, or dynamics unstable both ways
  bang_bang,              ///< controls that jump between their bounds
  local_optima,           ///< several local optima or stationary points
  phases,                 ///< several phases
  parameter_estimation,   ///< constants fitted to measurements
  free_final_time,
};
const char* to_string(Tag tag);
/// All tags, in the enum's order.
const std::vector<Tag>& all_tags();
/// Whether the tag says what makes a problem hard.
bool is_hard(Tag tag);

/// A value as printed.
struct Published {
  std::string printed;  ///< with its digits
  std::string where;    ///< who printed it
  double value() const;
  /// Half a unit of the last printed digit.
  double resolution() const;
};

/// A value known on paper.
struct ClosedForm {
  double value = 0;
  std::string formula;
};

/// A stated problem. `guesses` has one for each phase, or none for straight lines between the
/// bounds.
struct Statement {
  std::variant<ocp::Problem, ocp::PhasedProblem> problem;
  std::vector<ocp::Trajectory> guesses = {};
};

/// One problem of the library. Values are those of what the source minimises, or maximises.
struct Entry {
  std::string name;  ///< on the command line
  std::string title;
  std::string source;  ///< book or paper, with the number of the problem there
  std::string hard;    ///< what makes it hard, in a line
  std::vector<Tag> tags = {};
  bool maximised = false;  ///< its value is minus the objective that is solved for
  std::optional<Published> published = {};
  std::optional<ClosedForm> closed_form = {};
  /// The limit of refined meshes by two schemes and two solvers. Given where the printed value is
  /// that of a mesh, is wrong, or does not exist; `remark` has the figures.
  std::optional<double> converged = {};
  std::string remark = {};
  /// Tolerance of the refinement; this and the next two are the defaults unless these give less.
  double refinement = 1e-6;
  double tol = 1e-8;             ///< nlp::Options::tol
  bool resolve_controls = true;  ///< ocp::RefineRules::resolve_controls
  int intervals = 40;            ///< of the first mesh (of each phase) by a local scheme
  std::function<Statement()> state = {};

  bool has(Tag tag) const;
  /// What an answer is compared with: the closed form, else the converged value, else the print.
  double reference() const;
  /// How near an answer must come: 1e-5 of the reference (1e-5 for a reference of 0), or half the
  /// last printed digit if that is more and the printed value is the reference.
  double tolerance() const;
};

/// All published problems, in the order of the documentation.
const std::vector<Entry>& library();
/// The one of `entries` with this name. Throws InvalidValue for an unknown name, which names the
/// nearest.
const Entry& find(const std::vector<Entry>& entries, const std::string& name);

}  // namespace slalom::problems
