#include "../../src/world/road_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace slalom::world {
namespace {

TEST(RoadField, IsTheRoadOnTheCorridor) {
  std::vector<RoadPoint> line;
  for (double x = 0; x <= 200; x += 8) line.push_back({x, 15 * std::sin(x / 25), 3, 4});
  const Road road(line, false, {}, "winding");
  const RoadField field(std::make_shared<Road>(road));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> s(0, road.length()), n(-4.5, 5.5);
  for (int k = 0; k < 2000; ++k) {
    const RoadPlace at = road.at(s(random));
    const Point p = at.point() + at.aside() * n(random);
    // Near the middle the nearer edge changes from one side to the other.
    EXPECT_NEAR(field.edge_distance(p.x, p.y), road.edge_distance(p),
                road.edge_distance(p) > 2.5 ? 0.3 : 0.01);
    EXPECT_NEAR(field.along(p.x, p.y), road.project(p).s, 0.6);
  }
}

TEST(RoadField, IsTheRoadWhereThereIsNoGrid) {
  const RoadField field(std::make_shared<Road>(std::vector<RoadPoint>{{0, 0, 3, 3}, {100, 0, 3, 3}},
                                               false, std::vector<std::vector<Point>>{},
                                               "straight"));
  EXPECT_NEAR(field.edge_distance(50, 60), -57, 1e-9);
  EXPECT_LT(field.edge_distance(-1e6, 1e6), -9e5);
  // An open road goes on straight, near beyond its ends and far.
  for (const double x : {-200., -45., -20., -3., 110., 190.}) {
    EXPECT_NEAR(field.edge_distance(x, 1), 2, 1e-5) << x;
    EXPECT_NEAR(field.along(x, 1), x, 0.3) << x;
  }
}

}  // namespace
}  // namespace slalom::world
