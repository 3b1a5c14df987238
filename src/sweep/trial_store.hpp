#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slalom/report/sweep_table.hpp"
#include "sqlite.hpp"

namespace slalom::sweep {

class TrialStream;

inline constexpr int kStoreFormat = 5;         ///< of stores; another one is another version's
inline constexpr int kFormatBeforeStated = 4;  ///< it has no SweepTable::stated, and is read still
/// The columns of a store's trials, in the order in which they are written and read.
inline constexpr const char* kTrialColumns =
    "trial, identity, scenario, planner, axes, repeat, outcome, hit, message, nearest, time_s,"
    " goal_time_s, least_clearance_m, least_wheel_load_N, cycles, failed_cycles, iterations,"
    " max_solve_time_s, median_solve_time_s, max_cpu_time_s, median_cpu_time_s, p99_cpu_time_s,"
    " new_plans, rests, least_bads, marks";

/// The file a shard of a sweep is kept in: trials.sqlite, or trials-2-of-4.sqlite.
std::filesystem::path store_file(const std::filesystem::path& folder, int shard, int shards);
/// The shard i/n that a store of this name is of, 1/1 for trials.sqlite; nothing for other names.
std::optional<std::pair<int, int>> shard_of_store(const std::string& name);
/// All such files of a folder, sorted.
std::vector<std::filesystem::path> store_files(const std::filesystem::path& folder);

/// One shard's results in an SQLite file. A trial is there once and whole, or not at all, whatever
/// is killed. Every failure is an Error that names the file.
class TrialStore {
 public:
  /// Opens the store of a study, or makes it, in one step: it states the study (without
  /// `study.trials`) and `bases`: what the axes are crossed with, in the study's order, each as a
  /// resolved file, with which a trial can be driven again.
  TrialStore(const std::filesystem::path& file, const report::SweepTable& study,
             const std::vector<std::string>& bases);

  /// Records a trial; one that is there already stays as it is, unless it failed and this one did
  /// not.
  void add(const report::TrialRecord& record);
  /// All trials of a stream, in one transaction.
  void add_all(TrialStream& trials);
  /// Puts all into the one file, so that it can be copied by itself.
  void checkpoint() { database_.checkpoint(); }

 private:
  Database database_;
  std::unique_ptr<Statement> insert_;
};

/// Takes the trials numbered shard, shard + shards, ... out of a store: those of one outcome, or
/// all.
void forget_trials(const std::filesystem::path& file, int shard, int shards,
                   const std::string& outcome = "");

}  // namespace slalom::sweep
