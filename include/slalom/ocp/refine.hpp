#pragma once

#include <string>
#include <vector>

#include "slalom/ocp/errors.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// How an interval with too large an error is refined.
enum class Refinement {
  h,   ///< an interval is cut, by its scheme's order (Betts 2010, section 4.7)
  hp,  ///< its degree rises; past `max_points` it is cut (Patterson, Hager & Rao 2015)
};

struct RefineRules {
  double tolerance = 1e-6;  ///< of ErrorEstimate::largest
  Refinement refinement = Refinement::h;
  /// Intervals whose control is not resolved to the tolerance (unresolved_controls) are cut too,
  /// until the objective's relative change from mesh to mesh is below the tolerance. So are
  /// intervals where a bound of states is violated between the points (ErrorEstimate::bound_share),
  /// until the effect on the objective is less than twice the tolerance.
  bool resolve_controls = true;
  /// A small cost holds a control that oscillates from point to point, as on singular arcs, near
  /// its own average. The average is taken again from each answer, until the remaining effect on
  /// the objective is within five times the tolerance: up to 2 `max_meshes` more solves. Not used
  /// without `resolve_controls`.
  bool damp_chatter = true;
  int max_meshes = 15;
  int max_size = 20000;  ///< points of a mesh, over all phases
  int min_points = 3;    ///< hp: of the scheme in a new interval
  int max_points = 12;   ///< hp: of the scheme in any interval
};

/// How a refinement ended.
enum class RefineStatus {
  converged,   ///< every interval's error by re-integration is within the tolerance, and the
               ///< objective's first-order error within ten times the tolerance
  mesh_limit,  ///< `max_meshes` were solved, or twice as many with controls damped
  size_limit,  ///< the next mesh would have more than `max_size` points
  not_solved,  ///< a mesh was not solved: see the last record's status
  stopped,     ///< the time limit or the callback ended it once a mesh was solved
};
const char* to_string(RefineStatus status);

/// The result of one mesh.
struct MeshRecord {
  std::size_t intervals = 0, points = 0;
  nlp::Status status = nlp::Status::numerical_failure;
  int iterations = 0;
  double wall_s = 0;  ///< of the solve
  double objective = 0;
  double largest_error = 0;  ///< ErrorEstimate::largest
  /// How far the objective may be from its limit, relative to its magnitude. It is the largest of
  /// the sum of the intervals' shares (ErrorEstimate::objective_share), the change since the last
  /// mesh while a control is not resolved, and the possible effect of damping while a control is
  /// damped.
  double objective_error = 0;
  std::string worst_phase;  ///< the phase with that error; empty if there is only one
  std::size_t worst_interval = 0;
  std::size_t unresolved = 0;  ///< intervals whose control is not resolved
  double damping = 0;  ///< weight of the cost against chatter, relative to the objective's size
};

/// The records as a table of plain text, with the status below.
std::string table(const std::vector<MeshRecord>& meshes, RefineStatus status);

struct Refined {
  RefineStatus status = RefineStatus::not_solved;
  Solution solution;     ///< of the last mesh that was solved and judged; else of the first
  ErrorEstimate errors;  ///< empty if no mesh was judged
  std::vector<MeshRecord> meshes;
  /// Of a converged answer, how far its controls are from Pontryagin's minimum principle (Bryson &
  /// Ho 1975, section 3.4): the integral of H = L + costate' f less its least value over the
  /// controls allowed, in units of the objective, except beside bounds of states that hold. If it
  /// is much above the tolerance, the answer is stationary but no minimum, and a solve from the
  /// controls with that least value found nothing better: try another guess. 0 for problems with
  /// integrals, where it is not known.
  double hamiltonian_gap = 0;

  /// The records as a table of plain text, with the status below.
  std::string table() const { return ocp::table(meshes, status); }
};

struct PhasedRefined {
  RefineStatus status = RefineStatus::not_solved;
  PhasedSolution solution;            ///< as in Refined
  std::vector<ErrorEstimate> errors;  ///< of each phase
  std::vector<MeshRecord> meshes;
  double hamiltonian_gap = 0;  ///< as in Refined, of all phases

  /// The records as a table of plain text, with the status below.
  std::string table() const { return ocp::table(meshes, status); }
};

/// Solves on one mesh after another, each from the last one's polynomials and multipliers, until
/// the errors are within the tolerance. `start` has the first mesh, scheme and guess, and the
/// options and back end for all meshes; its time limit is of all meshes together, by the clock.
/// Throws InvalidValue for rules out of range, and for hp with a scheme that has only one degree.
[[nodiscard]] Refined refine(const Problem& problem, const SolveSettings& start = {},
                             const RefineRules& rules = {});
[[nodiscard]] PhasedRefined refine(const PhasedProblem& problem, const PhasedSettings& start = {},
                                   const RefineRules& rules = {});

}  // namespace slalom::ocp
