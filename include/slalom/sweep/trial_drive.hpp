#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace slalom::sweep {

/// The drive of a trial, as it stands in the folder of its sweep.
struct TrialDrive {
  std::filesystem::path folder;  ///< of the drive's files
  bool again = false;            ///< driven now; else it was kept
  bool interrupted = false;      ///< before its end: it does not stand there
  /// Whether the figures are those recorded; they are, unless the latency rule goes by the clock.
  bool as_recorded = true;
};

/// Sees to it that the drive of trial `number` of the sweep in `folder` stands there, in
/// drives/000123: drives it again if it was not kept, on the sweep's instruction set, which stays
/// selected. `interrupted` is polled while it drives; true ends it. Throws InvalidValue for a trial
/// that has not run or has no drive, Error where files cannot be read or written or another version
/// recorded it.
TrialDrive trial_drive(const std::filesystem::path& folder, std::int64_t number,
                       const std::function<bool()>& interrupted = {});

}  // namespace slalom::sweep
