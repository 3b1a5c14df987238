#pragma once

#include <string>

#include "builder.hpp"
#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

/// Throws InvalidValue, naming `where`, for bounds that no number satisfies.
void check_bounds(const std::string& where, Bounds bounds);

/// The same of a row, which without bounds would be no row.
void check_row_bounds(const std::string& where, Bounds bounds);

/// Throws InvalidValue where the bounds of t0 and tf leave no time that runs forward.
void check_times(const Problem& problem);

/// Throws InvalidValue for a row that no variable changes: a function of nothing, of numbers that
/// are given, or of a time that is fixed.
void check_rows(const Problem& problem, const Transcribed& data);

}  // namespace slalom::ocp
