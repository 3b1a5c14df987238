#pragma once

#include <vector>

#include "slalom/ocp/phases.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// The guesses given, and for each phase without one held_guess with what links say of its ends: a
/// state that a link makes continuous between two phases (or lets jump by a constant) takes, where
/// its own bounds tell nothing, a value on the line between the nearest ends that are told or
/// given before and after, or the value of the one there is.
std::vector<Trajectory> linked_guesses(const PhasedProblem& problem, std::vector<Trajectory> given);

}  // namespace slalom::ocp
