#pragma once

#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// solve() without further tries: one set-up and one solve of the NLP.
Solution solve_once(const Problem& problem, const SolveSettings& settings);
PhasedSolution solve_once(const PhasedProblem& problem, const PhasedSettings& settings);

}  // namespace slalom::ocp
