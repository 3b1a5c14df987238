#pragma once

#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// Takes full turns off the controls of `point`, in the NLP's units: where a control's neighbouring
/// values are more than half a turn apart, and the objective and all rows are the same without,
/// as of a heading that enters by its sine and cosine alone. Each value says the same then, but
/// between the points a polynomial through values some turns apart says nothing. Whether any were.
bool unwind(const Problem& problem, Transcription& transcription, std::vector<double>& x);

}  // namespace slalom::ocp
