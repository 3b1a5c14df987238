#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "../io/section.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::sweep {

/// What the axes of a study are crossed with.
struct StudyBases {
  std::vector<std::string> scenarios;  ///< by name, each once, in the study's order
  std::vector<sim::Scenario> all;      ///< each with each planner and `set`; planners vary fastest
  std::vector<std::string> stated;     ///< settings of the vehicle that `set` or --set states
};

/// Reads `scenario:` or `scenarios:`, `planners:` and `set:` of the study `root` that stands in
/// `file`; paths and patterns count from its folder. Throws InvalidValue for what is not there, for
/// names that are not told apart, and for settings that one of the scenarios does not take.
StudyBases read_bases(const io::Value& root, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides, io::Places& places);

/// Calls `apply`; where it throws InvalidValue for one of several scenarios, this names the one.
template <class F>
void apply_to(const StudyBases& bases, const sim::Scenario& scenario, const F& apply) {
  try {
    apply();
  } catch (const InvalidValue& bad) {
    if (bases.scenarios.size() <= 1) throw;
    throw InvalidValue(bad.where(), bad.found() + " for scenario '" + scenario.name + "'",
                       bad.expected());
  }
}

}  // namespace slalom::sweep
