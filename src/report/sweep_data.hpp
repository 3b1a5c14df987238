#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>

#include "slalom/report/sweep_table.hpp"

namespace slalom::report {

/// What the page says of a trial that is clicked on; viewer/sweep.js reads it.
nlohmann::ordered_json sweep_data(const SweepTable& sweep, const std::set<std::int64_t>& kept);

}  // namespace slalom::report
