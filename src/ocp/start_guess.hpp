#pragma once

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// What Transcription::straight_guess says.
Trajectory straight_guess(const Problem& problem);

/// Throws InvalidValue unless the guess has the problem's shape and finite numbers.
void check_guess(const Trajectory& guess, const Problem& problem);

}  // namespace slalom::ocp
