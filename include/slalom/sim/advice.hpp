#pragma once

#include <string>
#include <vector>

#include "slalom/sim/scenario.hpp"

namespace slalom::sim {

/// What is likely to go wrong in a scenario that is valid, in a sentence each: obstacles that pass
/// between two nodes of a plan, a goal behind the vehicle, gaps between standing obstacles through
/// which no plan leads, no way from start to goal (searched for as world::path_exists does), static
/// loads that do not sum to the weight. Takes up to a second.
std::vector<std::string> advice(const Scenario& scenario);

/// Of these, what is to be said as a drive starts, for it may drive on until its timeout: a goal
/// behind the vehicle. Found at once.
std::vector<std::string> advice_at_start(const Scenario& scenario);

}  // namespace slalom::sim
