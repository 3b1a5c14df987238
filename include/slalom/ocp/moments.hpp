#pragma once

#include "slalom/ocp/phases.hpp"

namespace slalom::ocp {

/// Nodes this near to a moment [share of the horizon] are at it.
inline constexpr double kAtMoment = 1e-9;

/// The grid with a node at each of Problem::moments(): an interval without this node is cut into
/// two intervals with its scheme. solve() and refine() do this by themselves.
PhasedTranscription::Grid with_moments(const Problem& problem,
                                       const PhasedTranscription::Grid& grid);

}  // namespace slalom::ocp
