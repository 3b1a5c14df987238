#pragma once

#include <vector>

#include "document.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::io {

/// The obstacles of one entry of a scenario's list: one, or a row of them. One without a name is
/// O`number`. Throws InvalidValue at the place of what is wrong.
std::vector<world::Obstacle> read_obstacles(const Value& map, std::size_t number);

/// What files say of an obstacle beside its options: "polygon: ..., table: ..." with ", " in front
/// of each, and empty for a plain one.
std::string obstacle_extras(const world::Obstacle& obstacle);

}  // namespace slalom::io
