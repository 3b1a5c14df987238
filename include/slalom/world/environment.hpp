#pragma once

#include <vector>

#include "slalom/world/goal.hpp"
#include "slalom/world/obstacle.hpp"
#include "slalom/world/region.hpp"

namespace slalom::world {

/// Where to, within what, and past what.
struct Environment {
  Goal goal;
  Region region;
  std::vector<Obstacle> obstacles;
};

}  // namespace slalom::world
