#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler.hpp"
#include "midpoints.hpp"
#include "sparsity.hpp"

namespace slalom::ocp {

/// A transcription while it is being built: rows, their linear terms, and where the results of the
/// batches go.
struct Draft {
  Draft(const Problem& problem, const Mesh& mesh, const Schemes& schemes);

  std::size_t add_row(RowName name, std::size_t stage, Bounds bounds, double scale);
  /// An output of a lane goes, times `coefficient`, to a row or a cost term (the other is kNone).
  void use(std::size_t batch, std::size_t output, std::size_t lane, std::size_t row,
           std::size_t term, double coefficient);
  std::size_t term_index(const std::string& name) const;
  std::size_t add_batch(const std::vector<Output>& outputs, const Lanes& lanes);
  /// Functions at points, in two batches where some are midpoints of compressed intervals.
  std::vector<std::size_t> add_batches(const std::vector<Output>& outputs, Points which,
                                       std::size_t family = kNone);
  /// Of an interval, in tau.
  double length(std::size_t k) const { return mesh.breakpoints()[k + 1] - mesh.breakpoints()[k]; }

  const Problem& problem;
  const Mesh& mesh;
  const Schemes& schemes;
  const Symbols symbols;
  Transcribed out;
  std::vector<RowInfo> rows;
  std::vector<RowTerm> linear;
  std::vector<std::vector<Use>> uses;  ///< of each batch
  std::vector<char> collocated;        ///< whether an interval collocates the point

 private:
  Compiler compiler_;
  std::optional<Midpoints> midpoints_;
};

/// Rates, integrands and path rows at all points; defects, quadratures, and what ties controls.
void add_dynamics(Draft& draft);

/// The path rows of one kind of points: their functions are appended to `outputs`.
std::vector<std::size_t> path_rows(const Draft& draft, Points which, std::vector<Output>& outputs);
/// Makes them rows, their functions being the batches' from `first_output` on.
void use_paths(Draft& draft, const std::vector<std::size_t>& batches, std::size_t first_output,
               const std::vector<std::size_t>& constraints);
/// All constraints but the path rows at all points; Mayer terms; what soft constraints cost.
void add_constraints(Draft& draft);

}  // namespace slalom::ocp
