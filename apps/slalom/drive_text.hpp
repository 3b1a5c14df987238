#pragma once

#include <string>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::app {

/// A drive in a few lines for a person at a terminal.
std::string drive_text(const sim::Scenario& scenario, const sim::Drive& drive);

}  // namespace slalom::app
