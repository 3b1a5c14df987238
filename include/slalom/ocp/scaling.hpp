#pragma once

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// The problem with a scale for every variable that had none: its largest size in the guess and at
/// the ends; else the size of its bounds; else what its rate makes of the others' sizes over the
/// horizon, or what moves another state by its size; else 1. Likewise for every constraint: the
/// size of its bounds, else how much it changes when all move by half their sizes. So the solver
/// sees the same numbers whatever the units (compare Betts 2010, section 4.8).
Problem with_scales(Problem problem, const Trajectory& guess);

}  // namespace slalom::ocp
