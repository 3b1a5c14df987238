#pragma once

#include <optional>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// What an expression of a problem's symbols comes to along its solution: one number for each point
/// of the trajectory. Throws InvalidValue, naming it, for a symbol of another problem.
std::vector<double> values(const Problem& problem, const Solution& solution,
                           const Expr& expression);
/// At any times, on the scheme's own polynomials; beyond t0 ... tf, at the nearer end.
std::vector<double> values(const Problem& problem, const Solution& solution, const Expr& expression,
                           const std::vector<double>& times);
/// Whether it is a function of states, controls or time, and not of ends, times and constants
/// alone.
bool changes_over_time(const Problem& problem, const Expr& expression);

}  // namespace slalom::ocp
