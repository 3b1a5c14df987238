#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "batch.hpp"
#include "layout.hpp"
#include "slalom/nlp/problem.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// What one column of a batch's data is filled with.
struct DataSource {
  enum class Kind { tau, t0, tf, parameter, member, weight } kind;
  std::size_t index;  ///< of the parameter, the member's number, or the soft constraint
  std::vector<std::uint32_t> points;  ///< of tau: by lane, where it is not the lane's own point
};

/// A row's name: `text`, or for a member of a family "family[member]text", for names may change.
struct RowName {
  std::string text;
  std::size_t family = kNone, member = 0;

  std::string in(const Problem& problem) const;
};

/// The row of a constraint (and member) at a point: what a multiplier belongs to.
struct RowOrigin {
  std::size_t constraint = kNone, member = 0, point = 0;
};

/// A soft row's excess: one variable a side (l1), or one of both signs (l2).
struct Excess {
  std::size_t row;
  std::size_t above = kNone, below = kNone;  ///< variables; l2 has `above` alone
};

struct BatchData {
  std::vector<DataSource> sources;
  std::size_t family = kNone;  ///< constraint whose members the lanes run over
};

/// Everything a transcription evaluates with.
struct Transcribed {
  Layout layout;
  std::vector<Batch> batches;
  std::vector<BatchData> batch_data;  ///< one for each batch
  LaneRuns linear;                    ///< from variables to rows
  LaneRuns linear_jacobian;           ///< the same terms' coefficients, from a 1
  std::vector<std::string> terms;     ///< cost terms switched on
  nlp::Structure structure;
  nlp::Limits limits;
  std::vector<RowName> row_names;
  /// [(defect * states + state) * intervals + interval]: its row; kNone where the interval's scheme
  /// has not so many defects.
  std::vector<std::size_t> defect_rows;
  std::size_t defect_begin = 0, defect_end = 0;             ///< all rows of defects
  std::vector<RowOrigin> origins;                           ///< one for each row
  std::vector<std::pair<std::size_t, std::size_t>> copies;  ///< row and lifted variable
  std::vector<Excess> excesses;                             ///< in order of their rows
  /// Batch 0 has rates and integrands at all points with states; for controls held over their
  /// intervals, `ends` has them at the intervals' ends with the control of before; `midpoints` at
  /// those of compressed intervals. kNone where there are none.
  std::size_t ends = kNone, midpoints = kNone;
  std::size_t first_integral = 0;  ///< of their outputs, which are rates, cost terms, integrals
  std::vector<std::size_t> integral_rows;
  std::vector<std::vector<double>> quadrature;  ///< weights [batch][lane] of the three
  std::vector<double> share_after;  ///< of each node's quadrature weight: the next interval's
};

inline std::size_t defect_row(const Transcribed& t, std::size_t defect, std::size_t state,
                              std::size_t interval) {
  return t.defect_rows[(defect * t.layout.nx + state) * t.layout.intervals() + interval];
}

/// Throws InvalidValue for what Transcription's constructor names.
Transcribed transcribe(const Problem& problem, const Mesh& mesh, const Schemes& schemes);

/// What a transcription evaluates with.
const Transcribed& transcribed_by(const Transcription& transcription);

/// Bounds of all variables, as `problem` has them now.
void fill_limits(const Problem& problem, Transcribed& transcribed);

/// The NLP's functions as expressions, each lane of a batch a copy of its function.
nlp::Formulas formulas(const Transcribed& transcribed);

/// Refills the batches' data from the problem's parameters and members. `before`: the problem whose
/// numbers they are; what it has too is left as it is.
void fill_data(const Problem& problem, Transcribed& transcribed, const Problem* before = nullptr);

}  // namespace slalom::ocp
