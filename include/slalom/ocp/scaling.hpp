#pragma once

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// The problem with a scale for every variable and constraint that had none, so that the solver
/// sees the same numbers whatever the units (compare Betts 2010, section 4.8).
///
/// A variable gets the first of these that is not 0: its largest size in the guess and at the ends;
/// the size of its bounds; what its rate makes of the others' sizes over the horizon, or what moves
/// another state by that state's size; 1. But a size in the guess is not less than a hundredth of
/// what the fixed ends and the controls' bounds make of it by the dynamics: rounding left in a
/// guess is no size. Times get the guess's duration. A constraint gets the size of its bounds, or
/// else how much it changes when all variables move by half their sizes.
Problem with_scales(Problem problem, const Trajectory& guess);

}  // namespace slalom::ocp
