#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "planner/scenes.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

inline std::shared_ptr<const world::Road> made_road(const std::vector<world::RoadPoint>& points,
                                                    bool closed) {
  return std::make_shared<world::Road>(points, closed, std::vector<std::vector<world::Point>>{},
                                       "road");
}

/// A closed road about an ellipse, of one width to each side.
inline std::shared_ptr<const world::Road> oval(double a, double b, double side) {
  std::vector<world::RoadPoint> points;
  for (int k = 0; k < 60; ++k) {
    const double angle = 2 * std::numbers::pi * k / 60;
    points.push_back({a * std::cos(angle), b * std::sin(angle), side, side});
  }
  return made_road(points, true);
}

/// Eastwards, round a loop, and back beside itself, 20 cm from the other branch's edge.
inline std::shared_ptr<const world::Road> narrow_loop() {
  std::vector<world::RoadPoint> points;
  for (double x = -20; x <= 100; x += 10) points.push_back({x, 0, 4, 4});
  const double half[][2] = {{110, -0.5}, {120, -4}, {132, -11}, {145, -15},
                            {158, -14},  {168, -7}, {172, 1}};
  for (const auto& [x, y] : half) points.push_back({x, y, 4, 4});
  for (std::size_t k = std::size(half); k-- > 0;)
    points.push_back({half[k][0], 8.2 - half[k][1], 4, 4});
  for (double x = 100; x >= -20; x -= 10) points.push_back({x, 8.2, 4, 4});
  return made_road(points, false);
}

inline vehicle::Parameters body() {
  vehicle::Parameters vehicle;
  vehicle.footprint = vehicle::FootprintKind::rectangle;
  return vehicle;
}

/// Round an oval by P_L, at 10 m/s first.
inline Scene by_P_L() {
  Scene scene;
  scene.road = oval(110, 55, 5);
  scene.vehicle = body();
  scene.planner.method = Method::along_road;
  scene.planner.N = 40;
  scene.planner.L_range = 150;
  scene.planner.floor = 0.03;
  const auto place = scene.road->at(0);
  scene.first.X0p = {place.x, place.y, 0, 0, place.psi, 0, 10, 0};
  return scene;
}

}  // namespace slalom::planner
