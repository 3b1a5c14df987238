#pragma once

#include <vector>

#include "json_file.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::io {

/// Obstacles with all that the bits of a plan depend on: shapes, trajectories, margins. A plain one
/// is its name and the numbers x, y, a, b, vx, vy.
Json json_obstacles(const std::vector<world::Obstacle>& obstacles);
std::vector<world::Obstacle> read_obstacles(const JsonReader& reader);

}  // namespace slalom::io
