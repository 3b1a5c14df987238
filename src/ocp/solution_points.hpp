#pragma once

#include <cstddef>
#include <vector>

#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// The point of each mesh node.
std::vector<std::size_t> node_points(const Solution& solution);

/// What a control takes on at the points, and its scale in the solve, 0 for a solution put together
/// by hand.
struct ControlRange {
  double low = kInfinity, high = -kInfinity, scale = 0;
};
ControlRange control_range(const Problem& problem, const Solution& solution, std::size_t control);

}  // namespace slalom::ocp
