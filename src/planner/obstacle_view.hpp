#pragma once

#include <vector>

#include "slalom/planner/settings.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::planner {

/// Obstacles as a planner that plans at t0 [s] takes them to move (Settings::prediction), and the
/// seconds ahead of their margins counted from then.
std::vector<world::Obstacle> believed(const Settings& settings,
                                      std::vector<world::Obstacle> obstacles, double t0);

/// Whether a row for it has numbers of their own at each moment.
bool varies(const world::Obstacle& obstacle);
/// Whether believed() depends on when one plans.
bool belief_varies(const Settings& settings, const std::vector<world::Obstacle>& obstacles);

/// What a row of an OCP keeps apart: a disc of an obstacle, or the whole of a plain one, and the
/// centre of a disc of the vehicle.
struct Pair {
  world::Obstacle obstacle;  ///< larger by the radius of the vehicle's disc
  double ahead = 0;          ///< of that disc's centre, from the front axle's on [m]

  /// The numbers xo, yo, a, b, vx, vy of a row that holds at about t [s]: the place at t = 0 of a
  /// body that passes with the obstacle's velocity where it is at t. Where it is absent for
  /// `around` s before and after, those of one far from everything.
  std::vector<double> numbers(double t, double around = 0) const;
};

/// Covers obstacles by discs (Settings::cover_excess).
std::vector<world::Obstacle> covered(const Settings& settings,
                                     const std::vector<world::Obstacle>& obstacles);
/// Every one of `discs`, as covered() leaves them, with every disc of the vehicle.
std::vector<Pair> pairs_of(const std::vector<world::Obstacle>& discs,
                           const std::vector<world::Disc>& vehicle);

}  // namespace slalom::planner
