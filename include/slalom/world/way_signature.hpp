#pragma once

#include <vector>

#include "slalom/world/obstacle.hpp"
#include "slalom/world/way_finder.hpp"

namespace slalom::world {

/// How a way passes an obstacle.
struct Passing {
  /// Angle that the way turns through about the obstacle's centre, counter-clockwise [rad]: about
  /// pi for a way that leaves it to the left, -pi to the right, 0 for one that stays behind it.
  double swept = 0;
  double nearest = 0;  ///< least distance between the way and the obstacle's centre [m]
  double when = 0;     ///< absolute time of that [s]
};

/// Of every obstacle, in their order.
using WaySignature = std::vector<Passing>;

/// How the way passes each of the obstacles; empty for a way without points.
WaySignature signature(const Way& way, const std::vector<Obstacle>& obstacles);

/// Whether two ways among the same obstacles from the same start to the same goal differ in how
/// they pass: one turns about an obstacle by 3/4 pi more than the other (another side, or before it
/// and after), or they pass two obstacles in another order, each by more than a second. Obstacles
/// count whose centre either way comes to within `reach` [m].
bool differ(const WaySignature& one, const WaySignature& other, double reach = 30);

}  // namespace slalom::world
