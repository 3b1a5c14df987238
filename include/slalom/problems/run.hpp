#pragma once

#include <string>
#include <vector>

#include "slalom/ocp/refine.hpp"
#include "slalom/problems/library.hpp"

namespace slalom::problems {

/// How to solve a problem of the library.
struct RunSettings {
  std::string scheme = "hermite_simpson";  ///< one of ocp::scheme_names()
  int points = 4;                          ///< of schemes that have a choice
  int intervals = 0;         ///< of the first mesh, of each phase; 0: the problem's own number
  double tolerance = 0;      ///< of the refinement; 0: the problem's own
  bool refined = true;       ///< false: only the first mesh is solved
  std::string backend = {};  ///< of nlp::make_solver; empty: the default one
};

/// A problem's answer, compared with its reference.
struct Run {
  ocp::RefineStatus status = ocp::RefineStatus::not_solved;
  std::string backend;
  double value = 0;       ///< with the source's sign
  double difference = 0;  ///< of value from Entry::reference(), relative; absolute where that is 0
  double error = 0;       ///< ErrorEstimate::largest of the last mesh
  std::vector<ocp::MeshRecord> meshes;
  double wall_s = 0;  ///< of all solves

  /// Converged (or solved, where there is no refinement), and within Entry::tolerance().
  bool agrees = false;
};

/// Solves and compares a problem. Options are the defaults except for `settings`. Throws
/// InvalidValue for settings out of range.
[[nodiscard]] Run run(const Entry& entry, const RunSettings& settings = {});

}  // namespace slalom::problems
