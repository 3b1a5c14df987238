#pragma once

#include <string>
#include <vector>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::sim {

/// Something that a drive's outcome does not tell and its reader is to know.
struct Mark {
  std::string kind;           ///< in a word, as files have it
  std::string text;           ///< one sentence, with the gravest case and when it was
  std::vector<double> times;  ///< of each case [s]
};

/// How far a plan begins from the state that it was made for: slack on its initial state.
struct StartSlack {
  double distance = 0;  ///< [m]
  double heading = 0;   ///< [rad], without sign
};
/// Zero for a cycle without a plan.
StartSlack start_slack(const Cycle& cycle);

/// Of a drive, in this order: plans that go through an obstacle between their nodes
/// (passes_through), or as deep into one as soft rows let them (soft_obstacle); plans that leave
/// their road between their nodes (plan_off_road); plans that were driven and begin more than .1 m
/// or 1 degree from the vehicle (start_slack); limits that plans keep and the plant broke: wheel
/// loads by more than 100 N (wheel_load), speed by more than .1 m/s (speed), the region's sides by
/// more than .1 m (region); the vehicle's body upon an obstacle, where the footprint is the front
/// axle's centre alone (body_overlap); 10 s more than 5 m farther from the goal than before,
/// without coming as near again meanwhile (moves_away); a crash by a verified plan, with what was
/// not as believed (verified_crash).
std::vector<Mark> marks(const Scenario& scenario, const Drive& drive);

}  // namespace slalom::sim
