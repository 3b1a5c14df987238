#pragma once

#include <utility>
#include <vector>

#include "slalom/world/goal.hpp"
#include "slalom/world/obstacle.hpp"
#include "slalom/world/region.hpp"

namespace slalom::world {

/// Distances to the goal's square around obstacles that stand, on a grid over start and goal:
/// Dijkstra's algorithm, each point joined to sixteen others. Memory is kept from call to call.
class DistanceField {
 public:
  /// From (x, y) [m] to `goal`, around those `obstacles` that stand. Within a margin of both.
  void fill(double x, double y, const Goal& goal, const Region& region,
            const std::vector<Obstacle>& obstacles);
  /// At the nearest point of the grid [m]; beyond the grid, and where no way leads, the straight
  /// line and a little more.
  double at(double x, double y) const;

 private:
  std::size_t cell(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(i);
  }
  void spread();

  Goal goal_;
  double x0_ = 0, y0_ = 0, step_ = 1.5;
  int nx_ = 0, ny_ = 0;
  std::vector<float> distance_;
  std::vector<char> shut_;
  std::vector<std::pair<float, int>> open_;
};

}  // namespace slalom::world
