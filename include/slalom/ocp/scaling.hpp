#pragma once

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// The problem with a scale for every variable and constraint that had none, so that the solver
/// sees the same numbers in any units (compare Betts 2010, section 4.8).
///
/// A variable gets the first of these that is not 0: its largest magnitude in the guess and at the
/// ends; the magnitude of its bounds; its change over the horizon by its rate at the other
/// variables' magnitudes, or the change that moves another state by that state's magnitude; 1. A
/// magnitude in the guess counts for at least a hundredth of the magnitude that the fixed ends and
/// the controls' bounds give through the dynamics, since a guess may contain only rounding errors.
/// An end below 1e-10 of what the other variables give through the dynamics, such as sin(pi), or
/// below 1e-12 where they give nothing, is taken for 0. Times get the guess's duration. A static
/// parameter gets its magnitude in the guess, at least a hundredth of that of its declared guess or
/// bounds; an integral that of its bounds, or else its magnitude in the guess, at least a hundredth
/// of duration times largest integrand. A constraint gets the magnitude of its bounds, or else its
/// change when all variables move by half their magnitudes; where that is only rounding, its
/// magnitude in the guess, or the largest change by one variable alone where that is over a hundred
/// times more.
Problem with_scales(Problem problem, const Trajectory& guess);

}  // namespace slalom::ocp
