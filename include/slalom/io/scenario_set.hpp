#pragma once

#include <filesystem>
#include <vector>

#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// Writes each scenario as FOLDER/NAME.yaml, all or none; the folder is made if need be. Throws
/// Error when one of the files stands already and not `force`, or cannot be written.
void write_scenarios(const std::filesystem::path& folder,
                     const std::vector<sim::Scenario>& scenarios, bool force);

}  // namespace slalom::io
