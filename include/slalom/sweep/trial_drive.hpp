#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace slalom::sweep {

/// The drive of a trial, as it stands in the folder of its sweep.
struct TrialDrive {
  std::filesystem::path folder;  ///< of the drive's files
  bool again = false;            ///< driven now; else it was kept
  bool interrupted = false;      ///< before its end: it does not stand there
  /// Which figures are not those recorded, and what they are; empty if all are. They differ where
  /// the latency rule, a deadline or a verifying planner goes by the clock, and where the trial was
  /// recorded as failed.
  std::string difference = {};
};

/// The drive of a trial if it was kept, compared with the record; nothing where there is none.
/// Throws as trial_drive() does.
std::optional<TrialDrive> kept_drive(const std::filesystem::path& folder, std::int64_t trial);

/// Sees to it that the drive of trial `number` of the sweep in `folder` stands there, in
/// drives/000123: if it was not kept, a process drives it again, by the command `worker` of one
/// that runs serve_trials(). A trial recorded as failed has ten minutes for that. `interrupted` is
/// polled meanwhile; true ends it. Throws InvalidValue for a trial that has not run, has no drive
/// or was recorded by another version, and where this processor lacks the sweep's instruction set;
/// Error where files cannot be read or written, or the process dies or hangs.
TrialDrive trial_drive(const std::filesystem::path& folder, std::int64_t number,
                       const std::vector<std::string>& worker,
                       const std::function<bool()>& interrupted = {});

}  // namespace slalom::sweep
