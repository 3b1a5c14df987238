#pragma once

#include <string>
#include <variant>

#include "slalom/planner/recording.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// A recorded solve with the scenario whose planner made it.
struct RecordedSolve {
  sim::Scenario scenario;
  planner::Recording recording;
};

/// A recorded plan of a planner that verifies, with its scenario.
struct RecordedMotion {
  sim::Scenario scenario;
  planner::RecordedPlan plan;
};
using Recorded = std::variant<RecordedSolve, RecordedMotion>;

/// One JSON file (docs/output-files.md), from which read_recording takes the same bits.
std::string to_json(const RecordedSolve& solve);
std::string to_json(const RecordedMotion& motion);
/// Throws InvalidValue with the file, the key, what was found and what was expected.
Recorded read_recording(const std::string& file);

/// Creates (with parents) a folder for recorded solves, removing those of an earlier drive if
/// `force`; throws Error when it holds any and `force` is false, or when it cannot be written.
void prepare_recordings(const std::string& folder, bool force);

}  // namespace slalom::io
