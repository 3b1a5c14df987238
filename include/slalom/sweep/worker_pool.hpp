#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace slalom::sweep {

/// One job: a line of text for a worker, which answers with one line. An empty line: what is next
/// is not known yet, ask again.
struct PoolJob {
  std::int64_t id = 0;
  std::string line;  ///< without line break
};

struct PoolSettings {
  /// Program and arguments of a worker. It writes the line "ready", then answers each line it reads
  /// with one line, and ends when its input does.
  std::vector<std::string> command;
  int workers = 1;
  /// How often a job is tried again whose worker died or hung; as often, counted by itself, one
  /// whose worker others killed.
  int retries = 2;
  double time_limit = 600;  ///< of one attempt [s]; then the worker counts as hung and is killed
};

/// What happens to jobs; all calls come from run_pool's own thread. An exception thrown here ends
/// the run (the workers are killed) and passes on.
struct PoolHooks {
  std::function<std::optional<PoolJob>()> next;  ///< the next job; nothing: there is none left
  std::function<void(std::int64_t id, int process, int attempt)> started;
  std::function<void(std::int64_t id, const std::string& answer)> done;
  /// An attempt that came to nothing; the last one of a job is followed by `failed` or `left`.
  std::function<void(std::int64_t id, const std::string& reason)> retried;
  std::function<void(std::int64_t id, const std::string& reason)> failed;
  /// Others killed the worker too often (out of memory, a batch system, a person), which says
  /// nothing of the job.
  std::function<void(std::int64_t id)> left;
  std::function<void()> tick;         ///< several times a second
  std::function<bool()> interrupted;  ///< polled; true ends the run at once
};

/// Runs all jobs on worker processes. A worker that dies or hangs costs its own attempt only: it is
/// replaced and the job tried again, at last reported as failed, or as left. Workers end with the
/// caller, by whatever it ends. Returns false when interrupted. Throws Error when workers cannot be
/// started or never get ready.
bool run_pool(const PoolSettings& settings, const PoolHooks& hooks);

}  // namespace slalom::sweep
