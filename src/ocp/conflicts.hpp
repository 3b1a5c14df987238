#pragma once

#include <vector>

#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// What stands against each other in an infeasible problem, from the multipliers of its least
/// violation (nlp::Answer::point): of each constraint and bound, and of fixed ends by themselves.
std::vector<Conflict> conflicts(const Problem& problem,
                                const std::vector<Multipliers>& multipliers);
/// The same of all phases and links.
std::vector<Conflict> conflicts(const PhasedProblem& problem, const PhasedSolution& solution);

/// Equations along the horizon of index 3 or more, by what their symbols' rates depend on.
std::vector<HighIndex> high_index(const Problem& problem);

}  // namespace slalom::ocp
