#pragma once

#include <span>

#include "builder.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// All of a trajectory that stands in the NLP's variables x; states at the midpoints of compressed
/// intervals do not, and are 0. It is linear in x.
Trajectory stored_trajectory(const Problem& problem, const Transcribed& transcribed,
                             std::span<const double> x);

}  // namespace slalom::ocp
