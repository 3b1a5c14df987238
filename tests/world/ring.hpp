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

/// Eastwards from the origin, round a bend to the left, and back beside itself; 6 m wide.
inline std::shared_ptr<const Road> hairpin() {
  std::vector<RoadPoint> line;
  for (double x = 0; x < 60; x += 10) line.push_back({x, 0, 3, 3});
  for (double angle = -1.5; angle < 1.6; angle += 0.3)
    line.push_back({60 + 20 * std::cos(angle), 20 + 20 * std::sin(angle), 3, 3});
  for (double x = 50; x >= 0; x -= 10) line.push_back({x, 40, 3, 3});
  return std::make_shared<Road>(std::move(line), false, std::vector<std::vector<Point>>{},
                                "hairpin");
}

}  // namespace slalom::world::test
