#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reproduction.hpp"

namespace slalom::paper {

/// What the paper says of a drive, by scenario and planner; nullptr when nothing.
const PaperDrive* find(const PaperData& paper, const ReproducedDrive& drive);
/// The first drive of an environment with a planner; nullptr when there is none.
const ReproducedDrive* find(const std::vector<ReproducedDrive>& drives,
                            const std::string& environment, const std::string& planner);

/// Whether a drive ends as the paper's: outcome, obstacle hit, and when.
bool as_paper(const sim::Drive& drive, const PaperDrive& paper);

/// How a drive ended, as within a sentence: "reached the goal".
std::string ended_words(const sim::Drive& drive);

/// CPU time of each cycle, the warm-up left out [s].
std::vector<double> cpu_times(const ReproducedDrive& one);

/// The drives, one group an environment, in their order.
std::vector<std::vector<const ReproducedDrive*>> by_environment(
    const std::vector<ReproducedDrive>& drives);

/// Text of the note on a topic; empty without one.
std::string note(const PaperData& paper, const std::string& topic);

/// Our vehicle beside the paper's at one of its snapshots.
struct PositionComparison {
  double t = 0;         ///< the instant compared [s]: the snapshot's, or our end just before it
  double x = 0, y = 0;  ///< ours [m]
  double psi = 0;       ///< [rad]
  double distance = 0;  ///< between the two front axles' centres [m]
  double unlagged = 0;  ///< the same with ours taken `lag` earlier [m]; NaN without lag
  bool comparable = true;
  bool within = true;  ///< distance <= tolerance
};

/// Nothing when our drive was over by then (more than .05 s before).
std::optional<PositionComparison> compare(const sim::Drive& drive, const PaperDrive& paper,
                                          const PaperDrive::Snapshot& snapshot);

}  // namespace slalom::paper
