#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "slalom/world/road.hpp"

namespace slalom::world::test {

/// A closed road to the left round a circle, from the origin eastwards; of one width to each side.
inline std::shared_ptr<const Road> ring(double radius, double half) {
  constexpr int kPoints = 36;
  std::vector<RoadPoint> points;
  for (int k = 0; k < kPoints; ++k) {
    const double angle = 2 * std::numbers::pi * k / kPoints;
    points.push_back({radius * std::sin(angle), radius - radius * std::cos(angle), half, half});
  }
  return std::make_shared<Road>(std::move(points), true, std::vector<std::vector<Point>>{}, "ring");
}

}  // namespace slalom::world::test
