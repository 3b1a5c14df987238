#pragma once

#include <vector>

#include "slalom/planner/planner.hpp"
#include "slalom/planner/settings.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::planner {

/// The obstacles with those of one velocity, one margin and less than obstacle_group_gap between
/// their edges replaced by one ellipse that covers them, in the order of the first of each group. A
/// chain of near ones is one group. Gaps are measured along the line of centres: exact for circles.
/// Those that are not plain stay on their own.
std::vector<world::Obstacle> group_obstacles(const Settings& settings,
                                             const std::vector<world::Obstacle>& obstacles);

/// The axis-aligned ellipse about the middle of the members' common box, with the box's ratio of
/// axes, scaled down as far as it covers every member: at most sqrt(2) times the half box. All have
/// one velocity and one margin; positions are those at t = 0.
world::Obstacle covering_ellipse(const std::vector<world::Obstacle>& members);

/// Whether one of them stays so far beyond what a plan for `request` can reach that its numbers
/// would only spoil the scale of the others' rows.
bool any_far(const Settings& settings, const Request& request,
             const std::vector<world::Obstacle>& obstacles);

/// Of `obstacles`, in their order, those that a plan for `request` knows of, as
/// Settings::obstacle_choice says, as rows have them (stand_ins()). Of one in parts in_reach keeps
/// the parts in reach. Far ones stand nearer than they are, still out of reach.
std::vector<world::Obstacle> choose_obstacles(const Settings& settings, const Request& request,
                                              const std::vector<world::Obstacle>& obstacles,
                                              const world::Footprint& footprint);

bool same_names(const std::vector<world::Obstacle>& a, const std::vector<world::Obstacle>& b);

}  // namespace slalom::planner
