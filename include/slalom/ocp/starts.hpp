#pragma once

#include <cstdint>
#include <vector>

#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// A randomly moved guess: smooth functions of the size of the variables' scales are added to
/// states and controls, and a free duration gets 3 to 40 times as long, all within their bounds.
/// The same seed gives the same guess.
Trajectory moved_guess(const Problem& problem, const Trajectory& guess, std::uint64_t seed);

/// Solves from several starts: first with the settings, then from their guess moved at random
/// (seeds `seed`, `seed` + 1, ...). Returns all answers in this order. Throws InvalidValue for
/// starts < 1.
[[nodiscard]] std::vector<Solution> solve_from_several(const Problem& problem,
                                                       const SolveSettings& settings, int starts,
                                                       std::uint64_t seed = 1);
[[nodiscard]] std::vector<PhasedSolution> solve_from_several(const PhasedProblem& problem,
                                                             const PhasedSettings& settings,
                                                             int starts, std::uint64_t seed = 1);

/// The index of the best answer: the solved one with the least objective, or 0 if none is solved.
std::size_t best_of(const std::vector<Solution>& answers);
std::size_t best_of(const std::vector<PhasedSolution>& answers);

}  // namespace slalom::ocp
