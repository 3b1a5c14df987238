#include "slalom/world/way_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../src/world/distance_field.hpp"

namespace slalom::world {
namespace {

using vehicle::State;

constexpr double kNorth = std::numbers::pi / 2;

/// 300 m from the start, which is northwards at 17 m/s, turned by `turn`.
struct Scene {
  Environment environment;
  State start{};
  double turn;

  explicit Scene(double by = 0) : turn(by) {
    environment.goal = {.psi = kNorth + by, .sigma = 15};
    std::tie(environment.goal.x, environment.goal.y) = at(0, 300);
    start = {0, 0, 0, 0, kNorth + by, 0, 17, 0};
  }
  std::pair<double, double> at(double x, double y) const {
    return {std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y};
  }
  void add(double x, double y, double r, double vx = 0, double vy = 0) {
    const auto [px, py] = at(x, y);
    const auto [qx, qy] = at(vx, vy);
    environment.obstacles.push_back(
        {"O" + std::to_string(environment.obstacles.size()), px, py, r, r, qx, qy});
  }
  std::optional<Way> way(const WaySearch& search = {}) const {
    return WayFinder(environment, {}).find(start, 1, environment.obstacles, search);
  }
};

/// Limits hold along a way, and obstacles are kept off; but for the corner that a chord of .05 s
/// cuts.
void expect_sound(const Scene& scene, const Way& way, const WaySearch& search) {
  EXPECT_EQ(way.front().t, 1);
  EXPECT_LT(scene.environment.goal.outside(way.back().x, way.back().y), 0);
  for (std::size_t k = 1; k < way.size(); ++k) {
    const auto &a = way[k - 1], &b = way[k];
    EXPECT_NEAR(b.t - a.t, 0.05, 1e-5);
    EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), b.v * (b.t - a.t), 0.02);
    EXPECT_LE(std::fabs(b.kappa - a.kappa), search.curvature_rate * 0.05 + 1e-5);
    EXPECT_LE(b.v, std::max(search.v_max, scene.start[vehicle::UX]) + 1e-5);
    EXPECT_LE(b.v * b.v * std::fabs(b.kappa), search.lateral_acceleration * 1.3);
    for (const auto& o : scene.environment.obstacles)
      EXPECT_GT(distance(o, b.x, b.y, b.t), search.clearance - 0.1) << o.name << " at " << b.t;
  }
}

TEST(WayFinder, PassesWhatStandsInTheWayWhereverTheGoalLies) {
  std::vector<double> times;
  for (const double turn : {0., -kNorth, 0.7, std::numbers::pi}) {
    Scene scene(turn);
    scene.add(0, 100, 6);
    scene.add(8, 170, 6);
    const auto way = scene.way();
    ASSERT_TRUE(way) << turn;
    expect_sound(scene, *way, {});
    times.push_back(way->back().t);
  }
  const auto [least, most] = std::minmax_element(times.begin(), times.end());
  EXPECT_LT(*most, 1.1 * *least) << "no direction is special";
}

TEST(WayFinder, WaitsForWhatComesThroughTheOnlyGap) {
  Scene scene;
  for (double x = 5; x < 60; x += 4) scene.add(x, 150, 2.5);
  for (double x = -5; x > -60; x -= 4) scene.add(x, 150, 2.5);
  const auto free = scene.way();
  ASSERT_TRUE(free);
  const double through = free->back().t;
  scene.add(0, 150 + 25 * 8, 2, 0, -25);  // in the gap at 8 s
  const auto way = scene.way();
  ASSERT_TRUE(way);
  expect_sound(scene, *way, {});
  EXPECT_GT(way->back().t, through);
}

TEST(WayFinder, LeavesADeadEndAside) {
  Scene scene;
  for (double x = -20; x <= 20; x += 4) scene.add(x, 120, 3);
  for (double y = 60; y < 120; y += 4)
    for (const double x : {-20., 20.}) scene.add(x, y, 3);
  const auto way = scene.way();
  ASSERT_TRUE(way);
  expect_sound(scene, *way, {});
}

TEST(WayFinder, FindsNoneThroughAWallAndSaysSo) {
  Scene scene;
  for (double x = -80; x <= 80; x += 4) scene.add(x, 150, 3);
  scene.environment.region.x_min = -60;
  scene.environment.region.x_max = 60;
  WaySearch search;
  search.max_places = 5000;
  WayFinder finder(scene.environment, {});
  EXPECT_FALSE(finder.find(scene.start, 1, scene.environment.obstacles, search));
  EXPECT_EQ(finder.looked_at(), 5000);
}

TEST(WayFinder, EndsWhenItsTimeIsOver) {
  Scene scene;
  for (double x = -80; x <= 80; x += 4) scene.add(x, 150, 3);
  WayFinder finder(scene.environment, {});
  int asked = 0;
  EXPECT_FALSE(
      finder.find(scene.start, 1, scene.environment.obstacles, {}, [&] { return ++asked == 3; }));
  EXPECT_LT(finder.looked_at(), 1000);
}

TEST(WayFinder, LeavesAnObstacleInWhichItStarts) {
  Scene scene;
  scene.add(1, 0, 3);
  scene.add(-3, 80, 5);
  EXPECT_TRUE(scene.way());
}

TEST(WayFinder, TheSameSearchGivesTheSameWayAgain) {
  Scene scene;
  scene.add(0, 100, 6);
  scene.add(20, 200, 5, -3, 0);
  WayFinder finder(scene.environment, {});
  const auto first = finder.find(scene.start, 1, scene.environment.obstacles, {});
  Scene other;
  other.add(5, 60, 4);
  finder.find(other.start, 1, other.environment.obstacles, {});
  const auto again = finder.find(scene.start, 1, scene.environment.obstacles, {});
  ASSERT_TRUE(first && again);
  ASSERT_EQ(first->size(), again->size());
  for (std::size_t k = 0; k < first->size(); ++k) {
    EXPECT_EQ((*first)[k].x, (*again)[k].x);
    EXPECT_EQ((*first)[k].v, (*again)[k].v);
  }
}

TEST(DistanceField, GoesAroundWhatStands) {
  Scene scene;
  DistanceField field;
  field.fill(0, 0, scene.environment.goal, {}, {});
  const double straight = field.at(0, 0);
  EXPECT_NEAR(straight, 300 - 0.4 * 15, 3);
  for (double x = -30; x <= 30; x += 4) scene.add(x, 150, 3);
  field.fill(0, 0, scene.environment.goal, {}, scene.environment.obstacles);
  // To the wall's end and back: 2 hypot(33, 150) but for the goal's half-width.
  EXPECT_NEAR(field.at(0, 0), 2 * std::hypot(33, 147), 12);
  EXPECT_GT(field.at(0, 0), straight + 3);
  scene.environment.obstacles.back().vx = 1;  // a gap of 4 m by what moves
  field.fill(0, 0, scene.environment.goal, {}, scene.environment.obstacles);
  EXPECT_LT(field.at(28, 0), 300);
}

TEST(DistanceField, StaysSmallForFarGoals) {
  Scene scene;
  scene.environment.goal.y = 20000;
  DistanceField field;
  field.fill(0, 0, scene.environment.goal, {}, {});
  EXPECT_NEAR(field.at(0, 0), 20000, 100);
  EXPECT_GT(field.at(5000, 0), 19000) << "off the grid: the line";
}

}  // namespace
}  // namespace slalom::world
