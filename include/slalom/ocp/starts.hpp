#pragma once

#include <cstdint>
#include <vector>

#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// A guess moved at random: states and controls by smooth functions of the variables' scales within
/// their bounds, a free duration 3 to 40 times as long, within its bounds. The same seed gives the
/// same guess.
Trajectory moved_guess(const Problem& problem, const Trajectory& guess, std::uint64_t seed);

/// Solves from several starts: first as the settings say, then from that guess moved at random
/// (seeds `seed`, `seed` + 1, ...). All answers, in this order. Throws InvalidValue for starts < 1.
[[nodiscard]] std::vector<Solution> solve_from_several(const Problem& problem,
                                                       const SolveSettings& settings, int starts,
                                                       std::uint64_t seed = 1);
[[nodiscard]] std::vector<PhasedSolution> solve_from_several(const PhasedProblem& problem,
                                                             const PhasedSettings& settings,
                                                             int starts, std::uint64_t seed = 1);

/// The place of the best: the solved one with the least objective, or the first if none is solved.
std::size_t best_of(const std::vector<Solution>& answers);
std::size_t best_of(const std::vector<PhasedSolution>& answers);

}  // namespace slalom::ocp
