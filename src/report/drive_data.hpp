#pragma once

#include <nlohmann/json.hpp>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::report {

/// What the data of a drive's page are, and which pages can be compared: those of the same format.
inline constexpr const char* kDriveFormat = "slalom drive 3";

/// Everything the page of a drive shows, as viewer/drive_model.js reads it. SI units and radians;
/// null stands for what is infinite, not a number or absent. Rounded to what a screen can show.
nlohmann::ordered_json drive_data(const sim::Scenario& scenario, const sim::Drive& drive);

}  // namespace slalom::report
