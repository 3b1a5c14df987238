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

/// A constant coefficient in a row: rows[row] += coefficient * x[col].
struct LinearTerm {
  std::uint32_t row, col;
  double coefficient;
};

/// What one column of a batch's data is filled with.
struct DataSource {
  enum class Kind { tau, parameter, member } kind;
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
  std::vector<LinearTerm> linear;
  std::vector<double> constant_jacobian;  ///< what the linear terms put there
  std::vector<std::string> terms;         ///< cost terms switched on
  nlp::Structure structure;
  nlp::Limits limits;
  std::vector<RowName> row_names;
  std::vector<std::size_t> first_defect;  ///< row of each interval's last defect of state 0
  std::size_t defects = 0;                ///< of an interval and state
  std::vector<double> share_after;        ///< of each node's quadrature weight: the next interval's
};

Transcribed transcribe(const Problem& problem, const Mesh& mesh, const Scheme& scheme);

/// Refills the batches' data from the problem's parameters and members.
void fill_data(const Problem& problem, Transcribed& transcribed);

}  // namespace slalom::ocp
