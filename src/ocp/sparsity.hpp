#pragma once

#include <string>
#include <vector>

#include "builder.hpp"

namespace slalom::ocp {

/// A row while the transcription is being built.
struct RowInfo {
  RowName name;
  std::size_t stage;
  Bounds bounds;  ///< user's unit
  double scale;   ///< row in the NLP = scale * the user's
  RowOrigin origin;
};

/// coefficient * (the user's value of variable col) in a row.
struct RowTerm {
  std::size_t row, col;
  double coefficient;
};

/// Where one output of one lane goes: a row or a cost term (the other is kNone).
struct Use {
  std::size_t output, lane, row, term;
  double coefficient;
};

/// Row part of structure, limits and names.
void fill_rows(const std::vector<RowInfo>& rows, Transcribed& out);

/// Patterns, and the runs that add every batch's results into them. Entries are numbered as they
/// are first met, formula by formula and within one lane by lane, which makes the runs long.
void fill_sparsity(const std::vector<RowInfo>& rows, const std::vector<RowTerm>& linear,
                   const std::vector<std::vector<Use>>& uses, Transcribed& out);

}  // namespace slalom::ocp
