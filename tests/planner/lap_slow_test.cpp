#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "slalom/planner/lap.hpp"

namespace slalom::planner {
namespace {

/// Three kilometres of bends to both sides: in sizes that grow with the road's length, such as n in
/// kilometres, a solve takes hundreds of iterations, where it ends.
TEST(Lap, ALongOneIsSolvedInAFewDozenIterations) {
  std::vector<world::RoadPoint> points;
  for (int k = 0; k < 300; ++k) {
    const double angle = 2 * std::numbers::pi * k / 300;
    const double r = 400 + 60 * std::sin(5 * angle) + 25 * std::sin(9 * angle + 1);
    points.push_back({r * std::cos(angle), r * std::sin(angle), 5, 5});
  }
  const world::Road road(points, true, {}, "flower");
  vehicle::Parameters body;
  body.footprint = vehicle::FootprintKind::rectangle;
  const Lap lap = fastest_lap(road, body, {.max_meshes = 2});
  ASSERT_TRUE(lap.refined.solution.solved()) << lap.refined.table();
  ASSERT_EQ(lap.refined.meshes.size(), 2u);
  for (const auto& mesh : lap.refined.meshes) EXPECT_LT(mesh.iterations, 100);
}

}  // namespace
}  // namespace slalom::planner
