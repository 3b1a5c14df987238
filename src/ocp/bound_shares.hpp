#pragma once

#include <vector>

#include "slalom/ocp/interpolant.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// ErrorEstimate::bound_share.
std::vector<double> bound_shares(const Problem& problem, const Solution& solution,
                                 const Interpolant& polynomials);

}  // namespace slalom::ocp
