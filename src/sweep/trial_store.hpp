#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slalom/report/sweep_table.hpp"
#include "sqlite.hpp"

namespace slalom::sweep {

/// The file a shard of a sweep is kept in: trials.sqlite, or trials-2-of-4.sqlite.
std::filesystem::path store_file(const std::filesystem::path& folder, int shard, int shards);
/// All such files of a folder, sorted.
std::vector<std::filesystem::path> store_files(const std::filesystem::path& folder);

/// The trials of several stores, one by one in trial order. Of equals the first store's comes.
class TrialStream {
 public:
  explicit TrialStream(const std::vector<std::filesystem::path>& stores);
  ~TrialStream();
  TrialStream(const TrialStream&) = delete;
  TrialStream& operator=(const TrialStream&) = delete;

  std::optional<report::TrialRecord> next();

 private:
  class Cursor;
  std::vector<std::unique_ptr<Cursor>> cursors_;
};

/// One shard's results in an SQLite file. A trial is there once and whole, or not at all, whatever
/// is killed. Every failure is an Error that names the file.
class TrialStore {
 public:
  /// Opens or makes the store of a study; `study.trials` is not looked at.
  TrialStore(const std::filesystem::path& file, const report::SweepTable& study);

  /// Records a trial; one that is there already stays as it is.
  void add(const report::TrialRecord& record);
  /// Records what the axes are crossed with, in the study's order, each as a resolved file: with it
  /// a trial can be driven again. What is there already stays.
  void keep_bases(const std::vector<std::string>& resolved);
  /// All trials of a stream in one transaction; returns their number.
  std::int64_t add_all(TrialStream& trials);
  /// Puts all into the one file, so that it can be copied by itself.
  void checkpoint() { database_.checkpoint(); }

 private:
  Database database_;
  std::unique_ptr<Statement> insert_;
};

/// The study whose trials a store holds, without these; its identity is empty when the store states
/// none yet. Throws Error for a file that is no such store.
report::SweepTable stored_study(const std::filesystem::path& file);

/// What keep_bases() recorded.
std::vector<std::string> stored_bases(const std::filesystem::path& file);
/// The one of them of which trial `number` is made. Throws Error where the store has none.
std::string stored_base(const std::filesystem::path& file, std::int64_t number);

/// The trial of this number, if the store holds it.
std::optional<report::TrialRecord> stored_trial(const std::filesystem::path& file,
                                                std::int64_t number);

/// Numbers of the trials in a store, in order.
std::vector<std::int64_t> stored_trials(const std::filesystem::path& file);

}  // namespace slalom::sweep
