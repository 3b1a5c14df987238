#pragma once

#include <string>

#include "section.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// Runs sim::check and gives its error the place of the value at fault; `whole`, the place of the
/// scenario itself, where none of `places` is that.
void check_scenario(const sim::Scenario& scenario, const Place& whole, const Places& places);

/// Of a scenario with all its settings: gives loop.sm_crash the default of the vehicle's footprint,
/// unless it is among those stated or was stated before.
void follow_footprint(sim::Scenario& scenario, const Places& stated);

/// Throws InvalidValue for a key of the goal that is among those stated and says nothing of a goal
/// of this kind: a place and a direction of a goal of the road, a half-width of a rectangle. Keys
/// of a file may be there where the command line puts another goal in their place.
void check_goal_keys(const sim::Scenario& scenario, const Places& stated);

}  // namespace slalom::io
