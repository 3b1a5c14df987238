// Guesses along a road, moved to the side of obstacles that is free.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "../../src/planner/free_way.hpp"
#include "slalom/vehicle/state.hpp"
#include "world/ring.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

world::Road straight() {
  return {{{-20, 0, 5, 5}, {40, 0, 5, 5}, {120, 0, 5, 5}}, false, {}, "road"};
}

world::Footprint body() {
  Parameters p;
  p.footprint = FootprintKind::rectangle;
  return world::Footprint(p);
}

/// Along the road at offset n, at 10 m/s.
ocp::Trajectory along(double n) {
  ocp::Trajectory guess;
  guess.tf = 5;
  for (int k = 0; k <= 50; ++k) {
    guess.tau.push_back(k / 50.);
    guess.states.push_back({k * 1., n, 0, 0, 0, 0, 10, 0});
    guess.controls.push_back({0, 0});
  }
  return guess;
}

world::Obstacle wall(double x, double y, double vx = 0) {
  world::Obstacle o{"wall", x, y, 1, 1, vx, 0};
  o.outline = std::make_shared<const world::Polygon>(world::Polygon::rectangle(4, 6));
  o.a = o.b = o.outline->reach();
  return o;
}

double least_distance(const ocp::Trajectory& guess, const std::vector<world::Obstacle>& obstacles) {
  double least = INFINITY;
  for (std::size_t k = 0; k < guess.tau.size(); ++k) {
    State x{};
    std::copy_n(guess.states[k].begin(), kStates, x.begin());
    for (const auto& o : obstacles)
      least = std::min(least, body().distance(o, x, 3 + guess.time(k)));
  }
  return least;
}

TEST(FreeWay, PassesWallsWhereTheyLeaveRoom) {
  const std::vector<world::Obstacle> walls = {wall(16, -2.5), wall(38, 2.5)};
  ASSERT_LT(least_distance(along(0.5), walls), 0);
  const auto guess = free_way(along(0.5), straight(), body(), 3, {walls, 0.3, 0});
  EXPECT_GT(least_distance(guess, walls), 0.1);
  EXPECT_EQ(guess.states.front(), along(0.5).states.front());
  EXPECT_GT(guess.states[16][Y], 1.5);
  EXPECT_LT(guess.states[38][Y], -1.5);
  for (std::size_t k = 0; k < guess.tau.size(); ++k) {
    EXPECT_NEAR(guess.states[k][X], along(0.5).states[k][X], 1e-6);
    EXPECT_LT(std::fabs(guess.states[k][PSI]), 0.4);
    EXPECT_EQ(guess.states[k][UX], 10);
  }
}

TEST(FreeWay, LooksWhereObstaclesAreWhenItIsThere) {
  // At t = 3 s + 3 s beside x = 30, where the second has gone on and the first has come to.
  const std::vector<world::Obstacle> walls = {wall(60, -2.5, -5), wall(30, 2.5, 20)};
  const auto guess = free_way(along(0), straight(), body(), 3, {walls, 0.3, 0});
  EXPECT_GT(least_distance(guess, walls), 0.1);
  EXPECT_GT(guess.states[30][Y], 1.5);
}

TEST(FreeWay, GoesOnAcrossTheSeamOfAClosedRoad) {
  const auto road = world::test::ring(40, 5);
  ocp::Trajectory guess;
  guess.tf = 5;
  for (int k = 0; k <= 50; ++k) {
    const auto at = road->at(road->length() - 20 + k);
    guess.tau.push_back(k / 50.);
    guess.states.push_back({at.x, at.y, 0, 0, at.psi, 0, 10, 0});
    guess.controls.push_back({0, 0});
  }
  const std::vector<world::Obstacle> walls = {wall(12, -1)};
  ASSERT_LT(least_distance(guess, walls), 0);
  const auto moved = free_way(guess, *road, body(), 3, {walls, 0.3, 0});
  EXPECT_GT(least_distance(moved, walls), 0.1);
  for (std::size_t k = 1; k < moved.tau.size(); ++k) {
    const auto &a = moved.states[k - 1], &b = moved.states[k];
    EXPECT_NEAR(std::hypot(b[X] - a[X], b[Y] - a[Y]), 1, 0.3) << k;
  }
}

TEST(FreeWay, NothingInTheWayLeavesTheGuess) {
  const std::vector<world::Obstacle> none;
  const auto guess = free_way(along(0.4), straight(), body(), 0, {none, 0.3, 0});
  for (std::size_t k = 0; k < guess.tau.size(); ++k) EXPECT_NEAR(guess.states[k][Y], 0.4, 1e-9);
}

}  // namespace
}  // namespace slalom::planner
