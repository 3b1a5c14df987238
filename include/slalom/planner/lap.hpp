#pragma once

#include <functional>
#include <vector>

#include "slalom/ocp/refine.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

/// Settings of the search for a fastest lap.
struct LapSettings {
  double interval = 6;  ///< approximate interval of the first mesh along the line [m]
  double margin = 0;    ///< distance between the body and the road's edges [m]
  /// Cost of a control at its limit [s/s]: small beside the time, but enough to make the answer
  /// unique where time alone does not determine the controls.
  double w_control = 0.01;
  double tolerance = 3e-4;  ///< relative change of the lap's cost from mesh to mesh
  int max_meshes = 4;
  std::function<bool()> interrupted = {};  ///< polled at every iteration
};

/// The fastest flying lap of a closed road by the vehicle's model: it ends in the state in which it
/// begins.
struct Lap {
  ocp::Refined refined;                ///< the answer to the problem along the line
  double time = 0;                     ///< of the lap [s]; the rest is empty if no mesh was solved
  std::vector<double> s, t;            ///< of each point: length along the line [m], lap time [s]
  std::vector<vehicle::State> states;  ///< in the world's frame
  std::vector<vehicle::Control> controls;
};

/// The shortest interval of a first mesh [m]: one along a road has at most 100 000.
double least_lap_interval(const world::Road& road);

/// Throws InvalidValue for a road that has two ends or is narrower than the vehicle, and for an
/// interval that is no number or shorter than least_lap_interval().
Lap fastest_lap(const world::Road& road, const vehicle::Parameters& vehicle,
                const LapSettings& settings = {});

}  // namespace slalom::planner
