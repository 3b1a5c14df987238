#pragma once

#include <optional>
#include <vector>

#include "slalom/planner/planner.hpp"
#include "slalom/planner/task.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

/// Where a cycle begins along the road's line, and where its goal lies from there.
struct WayAhead {
  double s = 0, n = 0;    ///< of X0p [m]
  double ahead = 0;       ///< of the goal, from s on [m]; negative where it lies behind
  double aim = 0;         ///< where a plan that comes to the goal ends, along the line [m]
  bool in_range = false;  ///< the goal lies within L_range, as the road goes
};

/// Looks where X0p is: by the nearest point of the line within Road::kWindow of `hint` [m], so that
/// a road which bends back on itself is followed, or of the whole line. A goal of the road alone,
/// which has no place across it, is as far as it is along it; one by time or laps is never in
/// range. The task has a road.
WayAhead way_ahead(const Task& task, const Request& request, std::optional<double> hint);

/// How far ahead of s the goal lies along the line [m]: by no more than half a lap of a closed
/// road, where a place that lies behind is ahead by the rest of the lap. What has no end is far
/// ahead.
double goal_ahead(const Task& task, double s);

/// s of places that follow each other along the road [m], the first of which lies about `s`; of a
/// closed road they go on rising beyond its length.
std::vector<double> follow(const world::Road& road, double s,
                           const std::vector<world::Point>& places);

/// How far to the left of the line a plan that comes to the goal ends [m]; none where the goal
/// reaches across the road.
std::optional<double> goal_offset(const Task& task);

}  // namespace slalom::planner
