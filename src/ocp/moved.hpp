#pragma once

#include <cstdint>

#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// The settings with their guess moved at random (moved_guess), without warm start.
SolveSettings moved(const Problem& problem, const SolveSettings& settings, std::uint64_t seed);
PhasedSettings moved(const PhasedProblem& problem, const PhasedSettings& settings,
                     std::uint64_t seed);

}  // namespace slalom::ocp
