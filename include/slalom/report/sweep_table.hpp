#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace slalom::report {

/// What one trial of a sweep came to. Figures that do not exist are NaN.
struct TrialRecord {
  std::int64_t trial = 0;  ///< 1, 2, ... in the study's order
  std::string identity;    ///< hash of the resolved configuration
  std::string scenario, planner;
  std::vector<std::string> values;  ///< one for each column of the table
  int repeat = 1;
  /// As sim::to_string(Outcome) has it; "failed" where no attempt came to an end, "invalid" where
  /// the values contradict each other. Both state why in `message`.
  std::string outcome;
  std::string hit, message, least_clearance_obstacle;
  double time = kNone;       ///< end of the drive [s]
  double goal_time = kNone;  ///< the goal's square first entered [s]
  double least_clearance = kNone, least_wheel_load = kNone;  ///< [m], [N]
  int cycles = 0, failed_cycles = 0, iterations = 0;         ///< the warm-up left out
  /// Of the cycles, by rung of the ladder (planner::Rung); 0 for a planner that does not verify.
  int new_plans = 0, rests = 0, least_bads = 0;
  /// Kinds of the drive's marks (sim::marks), with a space between each; empty too where the
  /// version that drove it did not record them.
  std::string marks;
  /// Measured: solve times over all cycles on the clock, failing ones included [s].
  double max_solve_time = kNone, median_solve_time = kNone;
  double max_cpu_time = kNone, p99_cpu_time = kNone, median_cpu_time = kNone;

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  bool passed() const { return outcome == "goal"; }
};

/// A sweep's results: those trials that have run, in trial order.
struct SweepTable {
  std::string name, title;
  std::string identity;                          ///< of the study
  std::string kernels;                           ///< instruction set
  std::vector<std::string> scenarios, planners;  ///< by name, in the study's order
  std::vector<std::string> columns;              ///< key paths of the axes
  /// Settings of the vehicle that the study states for all trials: no axis makes others of them.
  std::vector<std::string> stated;
  int repeats = 1;
  std::int64_t size = 0;  ///< trials of the whole study
  std::vector<TrialRecord> trials;
};

}  // namespace slalom::report
