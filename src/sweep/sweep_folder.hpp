#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "../io/file_lock.hpp"
#include "slalom/sweep/sweep.hpp"
#include "trial_store.hpp"

namespace slalom::sweep {

/// A store that this process alone writes while this lives, also when it is killed.
struct HeldStore {
  std::unique_ptr<io::FileLock> lock;
  std::unique_ptr<TrialStore> store;
};

/// Opens the store of `request.out` and the shard, for `study` and its `bases`. The folder is new,
/// empty or holds the same study; with `force` what other sweeps left there is removed, or, of a
/// shard while others are at work or whose study stands there already, what is left of its own
/// trials. One process at a time begins in a folder. Throws Error, and leaves the folder as it was,
/// when it holds something else, when a sweep is at work there on another study or on trials of
/// this one, or when `resume` demands results that are not there.
HeldStore open_store(const SweepRequest& request, const report::SweepTable& study,
                     const std::vector<std::string>& bases);

/// The study whose results stand in a folder, without its trials; throws InvalidValue when there is
/// none.
report::SweepTable study_of(const std::filesystem::path& folder);

/// Writes trials.csv of all that stands in the folder, whole or not at all.
SweepContent export_sweep(const std::filesystem::path& folder);

}  // namespace slalom::sweep
