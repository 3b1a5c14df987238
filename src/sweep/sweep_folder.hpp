#pragma once

#include <filesystem>

#include "../io/file_lock.hpp"
#include "slalom/sweep/sweep.hpp"

namespace slalom::sweep {

/// Sees to it that `folder` may take results of `study`: it is new, empty, or holds the same study.
/// `force` lets anything stand there. Throws Error otherwise, or when `resume` demands results that
/// are not there.
void prepare_sweep_folder(const std::filesystem::path& folder, const report::SweepTable& study,
                          bool resume, bool force);

/// Removes what a sweep left in the folder, nothing else.
void clear_sweep_folder(const std::filesystem::path& folder);

/// Keeps other sweeps out of a store while it lives, also when this process is killed.
class SweepLock {
 public:
  /// Throws Error when another process holds it.
  explicit SweepLock(const std::filesystem::path& store);

 private:
  io::FileLock lock_;
};

/// The study whose results stand in a folder, without its trials; throws Error when there is none.
report::SweepTable study_of(const std::filesystem::path& folder);

/// The folder of a kept drive.
std::filesystem::path drive_folder(const std::filesystem::path& folder, std::int64_t trial);

/// Writes trials.csv of all that stands in the folder, whole or not at all.
SweepContent export_sweep(const std::filesystem::path& folder);

}  // namespace slalom::sweep
