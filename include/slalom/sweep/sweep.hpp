#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "slalom/report/sweep_table.hpp"
#include "slalom/sweep/study.hpp"

namespace slalom::sweep {

/// How a study is swept.
struct SweepRequest {
  std::filesystem::path out;
  int jobs = 1;                       ///< worker processes
  std::optional<std::int64_t> limit;  ///< at most so many trials in this run
  int shard = 1, shards = 1;          ///< trials shard, shard + shards, shard + 2 shards, ...
  bool resume = false;                ///< demand that `out` holds this study already
  /// Replace what another sweep left in `out`; of a shard of the study that stands there, its own
  /// trials alone.
  bool force = false;
  bool again_failed = false;        ///< run trials again that stand there as failed
  std::vector<std::string> worker;  ///< command of a worker process, one that runs serve_trials()
};

/// Something that happened in a sweep.
struct SweepEvent {
  enum class Kind { begun, started, retried, recorded };
  Kind kind = Kind::begun;
  std::int64_t trial = 0;
  int process = 0, attempt = 0;                  ///< of `started`
  std::string reason;                            ///< of `retried`
  const report::TrialRecord* record = nullptr;   ///< of `recorded`
  std::int64_t total = 0, before = 0, done = 0;  ///< trials: of this shard; found done; run now
};

struct SweepHooks {
  std::function<void(const SweepEvent&)> on_event;
  std::function<void()> tick;  ///< several times a second
  std::function<bool()> interrupted;
};

/// How a sweep ended.
struct SweepSummary {
  std::int64_t total = 0;    ///< trials of this shard
  std::int64_t before = 0;   ///< found done
  std::int64_t done = 0;     ///< run and recorded now
  std::int64_t failed = 0;   ///< of these, failed or invalid
  std::int64_t pending = 0;  ///< left: the limit, an interruption, or killed workers
  std::int64_t killed = 0;   ///< of these, left because others killed their workers
  bool interrupted = false;
};

/// Throws InvalidValue where this processor lacks a study's instruction set. An OpenSweep does not
/// ask: its workers may be on other machines.
void check_kernels(const std::string& kernels);

/// Runs the trials of a study that `request.out` does not hold yet, records each as it ends and
/// writes trials.csv at the end. Whatever is killed, no recorded trial is lost or doubled. Throws
/// InvalidValue as check_kernels() does, and Error when the folder holds something else, cannot be
/// written or is in use.
SweepSummary run_sweep(const Study& study, const SweepRequest& request, const SweepHooks& hooks);

/// What stands in a folder, without the trials themselves.
struct SweepContent {
  report::SweepTable study;
  std::int64_t trials = 0;  ///< their number
};

/// Puts the results of several folders of one study into `out`; of equal trials one that has not
/// failed. Throws InvalidValue when a folder holds no results or those of another study, Error when
/// `out` holds something else, cannot be written or is in use.
SweepContent merge_sweeps(const std::vector<std::filesystem::path>& from,
                          const std::filesystem::path& out, bool force);

/// All trials that stand in a folder, of a sweep that is at work too. Throws InvalidValue when it
/// holds no sweep.
report::SweepTable read_sweep(const std::filesystem::path& folder);

/// The same as the text of trials.csv: one row a trial, in trial order: trial, scenario, planner,
/// the axes (and repeat), outcome, time_s, max_solve_time_s, then the rest.
std::string trials_csv(const std::filesystem::path& folder);

}  // namespace slalom::sweep
