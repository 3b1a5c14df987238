#pragma once

#include "builder.hpp"
#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

/// Throws InvalidValue where the bounds of t0 and tf leave no time that runs forward.
void check_times(const Problem& problem);

/// Throws InvalidValue for a row that no variable changes: a function of nothing, of numbers that
/// are given, or of a time that is fixed.
void check_rows(const Problem& problem, const Transcribed& data);

}  // namespace slalom::ocp
