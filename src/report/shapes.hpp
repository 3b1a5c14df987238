#pragma once

#include <vector>

#include "slalom/sim/scenario.hpp"

namespace slalom::report {

/// Points in order along an obstacle's edge at t [s], in the world's frame: enough for a picture.
std::vector<world::Point> edge_of(const world::Obstacle& obstacle, double t);

/// A motion by rows between which place and heading go evenly, to within a centimetre and half a
/// degree; for pictures. Its rows are those of the time in which the body is there.
struct Track {
  std::vector<world::TrajectoryRow> rows;
  bool appears = false, vanishes = false;  ///< at the first row, after the last
};
/// Of a motion from `begin` to `end` [s], by up to `most` rows.
Track track_of(const world::Trajectory& trajectory, double begin, double end, std::size_t most);

/// Lines of a road, from its first point to its last; a closed one's end where they begin.
struct RoadLines {
  std::vector<world::Point> left, right, middle;
};
RoadLines lines_of(const world::Road& road);

/// What of a goal is drawn: corners of a place, both ends of a line across the road, laps' where
/// the start is; nothing of a time.
std::vector<world::Point> goal_shape(const sim::Scenario& scenario);

}  // namespace slalom::report
