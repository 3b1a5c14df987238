#pragma once

#include <optional>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// The values of an expression of a problem's symbols along its solution, one for each point of the
/// trajectory. Throws InvalidValue for a symbol of another problem, naming it.
std::vector<double> values(const Problem& problem, const Solution& solution,
                           const Expr& expression);
/// The values at any times, by the scheme's own polynomials; beyond t0 ... tf, at the nearer end.
std::vector<double> values(const Problem& problem, const Solution& solution, const Expr& expression,
                           const std::vector<double>& times);
/// Whether an expression depends on states, controls or time, and not only on ends, end times and
/// constants.
bool changes_over_time(const Problem& problem, const Expr& expression);

}  // namespace slalom::ocp
