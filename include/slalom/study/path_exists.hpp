#pragma once

#include "slalom/sim/scenario.hpp"

namespace slalom::study {

/// The search of path_exists(): metres and seconds.
struct PathSearch {
  double dt = 0.5;               ///< of a move
  double cell = 1;               ///< of the grid, along and across
  double clearance = 0.5;        ///< kept beyond the crash check's margin sm_crash
  double v_min = 2, v_max = 24;  ///< speed along the line from start to goal [m/s]
  double slope = 0.5;            ///< most metres across for one along
  double half_width = 40;        ///< searched to each side of the line
  double t_max = 30;
};

/// Whether a point can move from the start into the goal's square past the obstacles, where they
/// are by then, within the region: breadth-first over a grid of places and times. Moves go along
/// the line from start to goal, never back, and are checked every twelfth of dt. What it finds is a
/// necessary condition for a drive in moderate turns, not a drive: the point turns and brakes at
/// once. A scenario it denies may have a way that goes back or leaves the grid.
bool path_exists(const sim::Scenario& scenario, const PathSearch& search = {});

}  // namespace slalom::study
