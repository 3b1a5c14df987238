#pragma once

#include <span>

#include "builder.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {

/// What Transcription::collocated_costates says.
CollocatedCostates collocated_costates(const Transcribed& data, const Schemes& schemes,
                                       std::span<const double> y);

/// Fills the multipliers of `start`, whose x stands: those of the defects so that
/// sum_d rate[d][j] y_d = -weight[j] costate at every point j; of rows and bounds so that they have
/// the same density over time. Those of copies, integrals and excesses are left at 0.
void carry_multipliers(const Problem& problem, const Transcribed& data, const Schemes& schemes,
                       const Duals& duals, nlp::Start& start);

/// Sets the multipliers of copies and integrals, and of the bounds of excesses, so that the
/// Lagrangian is stationary by these variables; `at` has the derivatives at `start`.
void settle_dependents(const Transcribed& data, const nlp::Evaluation& at, nlp::Start& start);

}  // namespace slalom::ocp
