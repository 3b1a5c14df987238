#include "slalom/ocp/moments.hpp"

#include <algorithm>
#include <utility>

namespace slalom::ocp {

PhasedTranscription::Grid with_moments(const Problem& problem,
                                       const PhasedTranscription::Grid& grid) {
  const auto moments = problem.moments();
  if (moments.empty()) return grid;
  grid.schemes.check(grid.mesh);
  const auto& breaks = grid.mesh.breakpoints();
  std::vector<double> nodes{0};
  std::vector<Scheme> schemes;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    for (const double moment : moments)
      if (moment > nodes.back() + kAtMoment && moment < breaks[k + 1] - kAtMoment) {
        nodes.push_back(moment);
        schemes.push_back(grid.schemes.of(k));
      }
    nodes.push_back(breaks[k + 1]);
    schemes.push_back(grid.schemes.of(k));
  }
  if (nodes.size() == breaks.size()) return grid;
  return {Mesh(std::move(nodes)), Schemes(std::move(schemes))};
}

}  // namespace slalom::ocp
