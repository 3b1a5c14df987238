#pragma once

#include <string>
#include <vector>

#include "slalom/report/svg.hpp"
#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::report {

/// Where a published figure has a vehicle at time t [s]: its front axle's centre [m].
struct PrintedPosition {
  double t = 0;
  double x = 0, y = 0;
  bool comparable = true;  ///< false: drawn dashed
};

/// One vehicle of a map: its path, and itself at some instants.
struct MapVehicle {
  const sim::Drive* drive = nullptr;
  std::string label;  ///< in the legend; empty: not there
  Stroke stroke;
  std::vector<double> instants;          ///< [s]; those after the drive's end are left out
  std::vector<PrintedPosition> printed;  ///< positions to mark beside it
  const planner::Plan* plan = nullptr;   ///< drawn with what it takes obstacles for, if any
};

/// A top view of a scenario for print, to scale.
struct Map {
  const sim::Scenario* scenario = nullptr;
  std::vector<MapVehicle> vehicles;
  std::vector<double> obstacle_instants;  ///< [s]; the last is drawn darkest
};

/// Thirds of a drive, its start and end included [s].
std::vector<double> thirds(const sim::Drive& drive);

/// The whole course: upright, or, if it is long and narrow, in three strips that lie one below the
/// other, driven from left to right.
std::string map_svg(const std::string& name, const std::string& title, const Map& map);

/// Maps of one course each, lying one below the other to one scale, driven from left to right.
struct Strip {
  std::string heading;
  Map map;
};
std::string strips_svg(const std::string& name, const std::string& title,
                       const std::vector<Strip>& strips);

/// A square of `half` metres to each side about (x, y), at the maps' instants.
std::string zoom_svg(const std::string& name, const std::string& title, const Map& map, double x,
                     double y, double half);

}  // namespace slalom::report
