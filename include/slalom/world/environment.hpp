#pragma once

#include <memory>
#include <vector>

#include "slalom/world/goal.hpp"
#include "slalom/world/obstacle.hpp"
#include "slalom/world/region.hpp"
#include "slalom/world/road.hpp"

namespace slalom::world {

/// Where to, within what, and past what.
struct Environment {
  Goal goal;
  Region region;
  std::vector<Obstacle> obstacles;
  std::shared_ptr<const Road> road = {};  ///< to stay on, if there is one

  /// Whether a vehicle in this state at t [s] has reached the goal.
  bool arrived(const vehicle::State& state, double t) const {
    return goal.reached(state, t, road.get());
  }
};

}  // namespace slalom::world
