#pragma once

#include <string>

#include "section.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// Runs sim::check and gives its error the place of the value at fault; `whole`, the place of the
/// scenario itself, where none of `places` is that.
void check_scenario(const sim::Scenario& scenario, const Place& whole, const Places& places);

}  // namespace slalom::io
