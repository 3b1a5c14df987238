#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "slalom/study/sweep_table.hpp"
#include "sqlite.hpp"

namespace slalom::io {

/// The file a shard of a sweep is kept in: trials.sqlite, or trials-2-of-4.sqlite.
std::filesystem::path store_file(const std::filesystem::path& folder, int shard, int shards);
/// All such files of a folder, sorted.
std::vector<std::filesystem::path> store_files(const std::filesystem::path& folder);

/// One shard's results in an SQLite file. A trial is there once and whole, or not at all, whatever
/// is killed. Every failure is an Error that names the file.
class TrialStore {
 public:
  /// Opens or makes the store of a study; `study.trials` is not looked at.
  TrialStore(const std::filesystem::path& file, const study::SweepTable& study);

  /// Records a trial; one that is there already stays as it is.
  void add(const study::TrialRecord& record);
  /// The trials of all tables in one transaction.
  void add_all(const std::vector<study::SweepTable>& tables);
  /// Puts all into the one file, so that it can be copied by itself.
  void checkpoint() { database_.checkpoint(); }

 private:
  Database database_;
  std::unique_ptr<Statement> insert_;
};

/// What a store holds; its identity is empty when it states no study yet. Throws Error for a file
/// that is no such store.
study::SweepTable read_store(const std::filesystem::path& file, bool with_trials = true);

/// Numbers of the trials in a store, in order.
std::vector<std::int64_t> stored_trials(const std::filesystem::path& file);

}  // namespace slalom::io
