#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch.hpp"
#include "layout.hpp"
#include "slalom/nlp/problem.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"

namespace slalom::ocp {

/// What one column of a batch's data is filled with.
struct DataSource {
  enum class Kind { tau, t0, tf, parameter, member } kind;
  std::size_t index;  ///< of the parameter or of the member's number
};

/// A row's name: `text`, or for a member of a family "family[member]text", for names may change.
struct RowName {
  std::string text;
  std::size_t family = kNone, member = 0;

  std::string in(const Problem& problem) const;
};

struct BatchData {
  std::vector<DataSource> sources;
  std::size_t family = kNone;  ///< constraint whose members the lanes run over
};

/// Everything a transcription evaluates with.
struct Transcribed {
  Layout layout;
  std::vector<Batch> batches;
  std::vector<BatchData> batch_data;  ///< one a batch
  LaneRuns linear;                    ///< from variables to rows
  LaneRuns linear_jacobian;           ///< the same terms' coefficients, from a 1
  std::vector<std::string> terms;     ///< cost terms switched on
  nlp::Structure structure;
  nlp::Limits limits;
  std::vector<RowName> row_names;
  /// [(defect * states + state) * intervals + interval]: its row; kNone where the interval's scheme
  /// has not so many defects.
  std::vector<std::size_t> defect_rows;
  std::size_t defect_begin = 0, defect_end = 0;  ///< all rows of defects
  std::vector<double> share_after;  ///< of each node's quadrature weight: the next interval's
};

inline std::size_t defect_row(const Transcribed& t, std::size_t defect, std::size_t state,
                              std::size_t interval) {
  return t.defect_rows[(defect * t.layout.nx + state) * t.layout.intervals() + interval];
}

/// Throws InvalidValue for what Transcription's constructor names.
Transcribed transcribe(const Problem& problem, const Mesh& mesh, const Schemes& schemes);

/// Refills the batches' data from the problem's parameters and members.
void fill_data(const Problem& problem, Transcribed& transcribed);

}  // namespace slalom::ocp
