#include "solution_points.hpp"

#include <algorithm>

namespace slalom::ocp {

std::vector<std::size_t> node_points(const Solution& solution) {
  std::vector<std::size_t> list{0};
  for (std::size_t k = 0; k < solution.mesh.intervals(); ++k)
    list.push_back(list.back() + solution.scheme.of(k).points.size() - 1);
  return list;
}

ControlRange control_range(const Problem& problem, const Solution& solution, std::size_t control) {
  ControlRange range;
  for (const auto& u : solution.trajectory.controls) {
    range.low = std::min(range.low, u[control]);
    range.high = std::max(range.high, u[control]);
  }
  const std::size_t place = problem.states().size() + control;
  if (place < solution.scales.size()) range.scale = solution.scales[place].second;
  return range;
}

}  // namespace slalom::ocp
