#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::report {

/// The cycles of a drive as its page carries them.
struct CyclesData {
  nlohmann::ordered_json cycles;
  std::size_t detailed = 0;  ///< so many with the terms of their cost and what else there was
  std::size_t nodes = 0;     ///< of each plan, at the most
  bool all_nodes = true;     ///< no plan has more
};

/// In about `bytes` of text. Where that is too little for all, there are fewer nodes of each plan;
/// then some cycles lack details; then the cycles are those that come first by_weight().
CyclesData cycles_data(const sim::Scenario& scenario, const sim::Drive& drive,
                       const std::vector<double>& marked, std::size_t bytes);

}  // namespace slalom::report
