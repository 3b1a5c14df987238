#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace slalom::sweep {

// What sweeps leave in their folder, by name. drives/, figures/, index.html and trials.csv may be
// anybody's: they are a sweep's only beside its stores.

/// The folder of a kept drive.
std::filesystem::path drive_folder(const std::filesystem::path& folder, std::int64_t trial);

/// Whether files that nobody takes for a sweep's are foreign, or are let pass.
enum class OtherFiles { count, pass };
/// A name in the folder that no sweep left there; empty if there is none.
std::string foreign_entry(const std::filesystem::path& folder, OtherFiles other_files);

/// Removes what sweeps left in the folder, nothing else; the stores last, so that after a kill the
/// rest still is a sweep's. Throws Error.
void clear_sweep(const std::filesystem::path& folder);

/// Removes what is there of the trials of one shard, for others are at work, or stay.
void clear_shard(const std::filesystem::path& folder, int shard, int shards);

/// Copies the kept drives that `out` does not have, each whole or not at all. A drive that is being
/// written, or taken away, while this runs is left out.
void copy_drives(const std::filesystem::path& folder, const std::filesystem::path& out);

}  // namespace slalom::sweep
