#pragma once

#include "section.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// The state in which a drive starts, by name.
struct Start {
  double x = 0, y = 0, v = 0, r = 0, psi = 0, sa = 0, ux = 0, ax = 0;

  explicit Start(const vehicle::State& state);
  vehicle::State state() const;
};

/// An obstacle as files write it: a circle or an ellipse, once or in a row.
struct ObstacleEntry {
  world::Obstacle obstacle;
  int repeat = 1;
  std::array<double, 2> step = {0, 0};  ///< from one to the next [m]
};

const OptionTable<Start>& start_options();
const OptionTable<world::Goal>& goal_options();
const OptionTable<world::Region>& region_options();
/// name, x, y, a, b, vx, vy: what one obstacle is.
const OptionTable<world::Obstacle>& obstacle_options();
/// repeat, step: how a file writes many.
const OptionTable<ObstacleEntry>& repeat_options();

/// Sections bound to the parts of a scenario, with the keys that are not plain options (angles in
/// degrees, an obstacle's radius).
Section start_section(Start& start);
Section goal_section(world::Goal& goal);
Section region_section(world::Region& region);
Section obstacle_section(world::Obstacle& obstacle, const std::string& path);

}  // namespace slalom::io
