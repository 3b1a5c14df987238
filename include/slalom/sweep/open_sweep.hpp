#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "slalom/sweep/sweep.hpp"

namespace slalom::sweep {

/// A trial that waits to be run.
struct TrialJob {
  std::int64_t trial = 0;  ///< 0: none is known yet, ask again
  std::string order;       ///< one line, all that a worker needs to know
};

/// A sweep at work on its folder, whoever runs the trials: hands out those that wait and records
/// what came of them. It alone writes there; other sweeps are kept out while it lives. What was
/// handed out and never recorded is run by the next sweep. Memory does not grow with the number of
/// trials but for one bit each.
class OpenSweep {
 public:
  /// `study` must outlive it. Of `request`, jobs and worker are not looked at. Throws Error when
  /// the folder holds something else, cannot be written or is in use.
  OpenSweep(const Study& study, const SweepRequest& request,
            std::function<void(const SweepEvent&)> on_event = {});
  ~OpenSweep();
  OpenSweep(const OpenSweep&) = delete;
  OpenSweep& operator=(const OpenSweep&) = delete;

  /// The next trial that has not been run; nothing: there is none, or the limit is reached. Trials
  /// whose values contradict each other are recorded as `invalid` on the way, some of them at a
  /// call.
  std::optional<TrialJob> next();
  /// Records what a worker answered. Throws Error when the drive's files could not be written.
  void record(std::int64_t trial, const std::string& answer);
  /// Records a trial of which no attempt came to an end.
  void record_failed(std::int64_t trial, const std::string& reason);
  /// Counts so far.
  SweepSummary summary() const;
  /// Writes trials.csv. Nothing may follow.
  void finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A worker: answers the trials' orders that come on standard input until it ends.
void serve_trials();

}  // namespace slalom::sweep
