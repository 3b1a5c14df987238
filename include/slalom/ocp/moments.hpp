#pragma once

#include "slalom/ocp/phases.hpp"

namespace slalom::ocp {

/// Nodes this near to a moment [share of the horizon] are at it.
inline constexpr double kAtMoment = 1e-9;

/// The grid with a node at each of Problem::moments(): where there is none, an interval is cut in
/// two of its scheme. solve() and refine() do so by themselves.
PhasedTranscription::Grid with_moments(const Problem& problem,
                                       const PhasedTranscription::Grid& grid);

}  // namespace slalom::ocp
