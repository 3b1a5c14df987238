#pragma once

#include <string>

#include "section.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// Runs sim::check and gives its error the line of the key it is about, as far as one stands in
/// the file or on the command line.
void check_scenario(const sim::Scenario& scenario, const std::string& file, const Places& places);

}  // namespace slalom::io
