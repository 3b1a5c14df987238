#pragma once

#include <string>
#include <vector>

#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

/// Says kinks in the cost's integrands by smooth rows: an abs or max that is to be small, and a min
/// that is to be large, become a control of their own with two path rows that hold it above (below)
/// both of its values, so that the least cost is the same (compare Betts 2010, section 2.7). Their
/// cost terms are switched off for new ones. Only what stands in sums and products with constants
/// is rewritten. Returns a sentence for each, saying what it did.
std::vector<std::string> smooth_kinks(Problem& problem);

}  // namespace slalom::ocp
