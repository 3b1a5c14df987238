#pragma once

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// Sets the guess to where controls lead that are held at a share of the way from their lower to
/// their upper bound; whether they lead to the horizon's end.
bool simulated(const Problem& problem, double share, double time_limit, SolveSettings& settings);

}  // namespace slalom::ocp
