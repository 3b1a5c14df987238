#pragma once

#include "descent.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp::ipm {

/// Sets scales, barrier and the first point of a solve (Waechter & Biegler 2006, sections 3.6 and
/// 3.8), complete. False when a function is not finite there.
///
/// Variables are moved inside their bounds; slacks take their rows' values, moved inside likewise.
/// Cold, multipliers of bounds are mu / slack and those of rows fit the gradient. Warm, the
/// multipliers given are kept where they are central, else set to mu / slack, and a slack keeps the
/// distance from its bound at which its multiplier would hold it.
[[nodiscard]] bool prepare(Descent& descent, const Start& start, const Options& options);

/// A point of the method in the problem's terms.
void hand_out(const Model& model, const Iterate& at, Start& out);

}  // namespace slalom::nlp::ipm
