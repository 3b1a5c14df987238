#pragma once

#include <string>
#include <vector>

#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

/// Replaces kinks in the cost's integrands by smooth rows. An abs or max that is minimised, or a
/// min that is maximised, becomes a new control with two path rows that hold it above (below) both
/// of its values, so the least cost is the same (compare Betts 2010, section 2.7). New cost terms
/// replace the old ones, which are switched off. Only kinks in sums and in products with constants
/// are rewritten. Returns one sentence about each.
std::vector<std::string> smooth_kinks(Problem& problem);

/// Names of the cost terms that it would replace.
std::vector<std::string> costs_with_kinks(Problem problem);

}  // namespace slalom::ocp
