#pragma once

#include <vector>

#include "slalom/planner/belief.hpp"
#include "slalom/planner/settings.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::planner {

/// Whether a row for it has numbers of their own at each moment.
bool varies(const world::Obstacle& obstacle);

/// Obstacles as rows have them (ObstacleRows): plain ellipses to a footprint that is a point, and
/// circles, as they are; circles over bodies out of which they stick by Settings::cover_excess at
/// the most; else a rectangle that covers the body, or to a point an ellipse. To a point it is
/// cut into up to six in a row: each row is a term of the barrier that keeps plans off it, and
/// is as round as its margin at its corners.
std::vector<world::Obstacle> stand_ins(const Settings& settings, const world::Footprint& footprint,
                                       const std::vector<world::Obstacle>& obstacles);

/// Whether obstacles are the same but for their names. Margins count from one moment or another:
/// less is left of them then.
bool same(const std::vector<world::Obstacle>& a, const std::vector<world::Obstacle>& b);

}  // namespace slalom::planner
