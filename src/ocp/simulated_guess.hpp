#pragma once

#include <optional>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/simulate.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// Where controls lead from the first states of `from`, with its times, static parameters and
/// slacks. Nothing where that is not its end within a second, the limits' time and callback, or
/// where rates use final values.
std::optional<Trajectory> led_by(const Problem& problem, const Trajectory& from,
                                 const Controls& controls, const nlp::Options& limits);

/// Sets the guess to where controls lead that are held at a share of the way from their lower to
/// their upper bound; whether they lead to the horizon's end.
bool simulated(const Problem& problem, double share, double time_limit, SolveSettings& settings);

}  // namespace slalom::ocp
