#include "../../src/world/goal_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace slalom::world {
namespace {

constexpr double kHalf = 5;  ///< of the goal's sides [m]

GoalField field(double start_u, double start_w, const std::vector<Ellipse>& obstacles,
                const Region& region = {}) {
  GoalField result;
  result.build({}, start_u, start_w, kHalf, kHalf, region, obstacles);
  return result;
}

TEST(GoalField, IsNearlyTheStraightLineWhereNothingIs) {
  const auto f = field(-100, 20, {});
  for (double angle = 0; angle < 6.2; angle += 0.1) {
    const double u = 40 * std::cos(angle), w = 40 * std::sin(angle);
    const double line =
        std::hypot(std::max(std::fabs(u) - kHalf, 0.0), std::max(std::fabs(w) - kHalf, 0.0));
    EXPECT_NEAR(f(u, w), line, 2.5) << angle;
  }
  EXPECT_EQ(f(0, 0), 0);
}

TEST(GoalField, LeadsAroundWhatStands) {
  const Ellipse wall = {-40, 0, 0, 0, 3, 30};
  const auto f = field(-80, 0, {wall});
  // Over the wall's end at (-40, 30) to the goal's corner at (-5, 5).
  EXPECT_NEAR(f(-80, 0), std::hypot(40, 30) + std::hypot(35, 25), 4);
  const Ellipse moving = {-40, 0, 1, 0, 3, 30};
  EXPECT_NEAR(field(-80, 0, {moving})(-80, 0), 75, 2.5) << "gone by then";
}

TEST(GoalField, StaysInTheRegion) {
  Region region;
  region.x_min = -90;
  region.y_max = 20;
  region.y_min = -45;
  const Ellipse wall = {-40, 0, 0, 0, 3, 30};
  EXPECT_NEAR(field(-80, 10, {wall}, region)(-80, 10), std::hypot(40, 40) + std::hypot(35, 25), 5)
      << "around the wall's other end";
  region.y_min = -20;
  EXPECT_EQ(field(-80, 10, {wall}, region)(-80, 10), std::hypot(80, 10) - kHalf + 10) << "no path";
}

TEST(GoalField, TakesACoarserGridForAFarGoal) {
  const auto f = field(-2e6, 5e5, {});
  EXPECT_NEAR(f(-2e6, 5e5), std::hypot(2e6, 5e5), 6e4);
  EXPECT_EQ(f(-3e6, 0), 3e6 - kHalf + 20) << "outside the box";
}

}  // namespace
}  // namespace slalom::world
