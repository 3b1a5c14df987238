#pragma once

#include <functional>
#include <vector>

#include "slalom/ocp/refine.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

/// How a fastest lap is found.
struct LapSettings {
  double interval = 6;  ///< of the first mesh along the line, about [m]
  double margin = 0;    ///< that the body keeps from the road's edges [m]
  /// Cost of a control at its limit [s/s]: small beside the time, and enough to make the answer
  /// unique where time alone leaves the controls open.
  double w_control = 0.01;
  double tolerance = 3e-4;  ///< relative change of the lap's cost from mesh to mesh
  int max_meshes = 4;
  std::function<bool()> interrupted = {};  ///< polled at every iteration
};

/// The fastest flying lap of a closed road, as the vehicle's model has it: it ends as it begins.
struct Lap {
  ocp::Refined refined;      ///< as the problem along the line has it
  double time = 0;           ///< of the lap [s]; the rest is empty where no mesh was solved
  std::vector<double> s, t;  ///< of each point: along the line [m], since the lap began [s]
  std::vector<vehicle::State> states;  ///< in the world's frame
  std::vector<vehicle::Control> controls;
};

/// Throws InvalidValue for a road that has two ends or is narrower than the vehicle.
Lap fastest_lap(const world::Road& road, const vehicle::Parameters& vehicle,
                const LapSettings& settings = {});

}  // namespace slalom::planner
