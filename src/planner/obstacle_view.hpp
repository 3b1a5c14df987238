#pragma once

#include <array>
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

/// The numbers of a row about t [s]: xo, yo, a, b, vx, vy, the place at t = 0 of a body that passes
/// with the obstacle's velocity where it is at t. Where it is absent for `around` s before and
/// after, kNowhere.
std::array<double, 6> numbers_at(const world::Obstacle& obstacle, double t, double around = 0);
/// Those of one far from everything.
inline constexpr std::array<double, 6> kNowhere = {1e5, 1e5, 1e3, 1e3, 0, 0};

/// Obstacles as rows and search have them: discs that cover them (Settings::cover_excess), but for
/// plain ones to a footprint that is a point, and for circles.
std::vector<world::Obstacle> covered(const Settings& settings, const world::Footprint& footprint,
                                     const std::vector<world::Obstacle>& obstacles);

}  // namespace slalom::planner
