#pragma once

#include <string>
#include <vector>

#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// Names of bounds and path rows that hold states and time alone, and not softly.
std::vector<std::string> rows_of_states(const Problem& problem);

/// ErrorEstimate::bound_share.
std::vector<double> bound_shares(const Problem& problem, const Solution& solution,
                                 const Interpolant& polynomials);

}  // namespace slalom::ocp
