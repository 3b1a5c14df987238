#include "slalom/io/sweep.hpp"

#include <fmt/format.h>

#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/study/worker_pool.hpp"
#include "sweep_folder.hpp"
#include "trial_message.hpp"
#include "trial_store.hpp"

namespace slalom::io {
namespace fs = std::filesystem;
namespace {

study::SweepTable table_of(const Study& study) {
  study::SweepTable table;
  table.name = study.name;
  table.title = study.title;
  table.identity = study.identity();
  table.kernels = study.kernels;
  table.scenarios = study.scenarios;
  table.planners = study.planners();
  table.columns = study.columns();
  table.repeats = study.settings.repeats;
  table.size = study.size();
  return table;
}

/// One run over a shard's pending trials. Memory does not grow with their number but for one bit
/// each.
class Sweep {
 public:
  Sweep(const Study& study, const SweepRequest& request, const SweepHooks& hooks, TrialStore& store)
      : study_(study), request_(request), hooks_(hooks), store_(store), next_(request.shard) {
    find_done();
  }

  SweepSummary run() {
    report({});
    study::PoolHooks pool;
    pool.next = [this] { return next_job(); };
    pool.started = [this](std::int64_t id, int process, int attempt) {
      SweepEvent event;
      event.kind = SweepEvent::Kind::started;
      event.trial = id;
      event.process = process;
      event.attempt = attempt;
      report(event);
    };
    pool.retried = [this](std::int64_t id, const std::string& reason) {
      SweepEvent event;
      event.kind = SweepEvent::Kind::retried;
      event.trial = id;
      event.reason = reason;
      report(event);
    };
    pool.done = [this](std::int64_t id, const std::string& answer) { take(id, answer); };
    pool.failed = [this](std::int64_t id, const std::string& reason) {
      study::TrialRecord record;
      record.outcome = "failed";
      record.message = reason;
      keep(id, std::move(record));
    };
    pool.tick = hooks_.tick;
    pool.interrupted = hooks_.interrupted;
    summary_.interrupted = !study::run_pool(
        {request_.worker, request_.jobs, study_.settings.retries, study_.settings.time_limit},
        pool);
    summary_.pending = summary_.total - summary_.before - summary_.done;
    return summary_;
  }

 private:
  void find_done() {
    done_.assign(static_cast<std::size_t>(study_.size()) + 1, false);
    for (const auto& file : store_files(request_.out))
      for (const auto number : stored_trials(file))
        done_.at(static_cast<std::size_t>(number)) = true;
    for (std::int64_t n = request_.shard; n <= study_.size(); n += request_.shards) {
      ++summary_.total;
      summary_.before += done_[static_cast<std::size_t>(n)];
    }
  }

  /// The next trial that is to be run; those whose values contradict each other are recorded as
  /// such on the way.
  std::optional<study::PoolJob> next_job() {
    for (; next_ <= study_.size(); next_ += request_.shards) {
      if (done_[static_cast<std::size_t>(next_)]) continue;
      if (request_.limit && given_ >= *request_.limit) return std::nullopt;
      ++given_;
      const auto number = next_;
      try {
        TrialOrder order;
        order.resolved = to_yaml(study_.resolve(study_.trial(number)));
        order.kernels = study_.kernels;
        if (study_.settings.keep == Keep::drives)
          order.folder = drive_folder(request_.out, number).string();
        next_ += request_.shards;
        return study::PoolJob{number, to_line(order)};
      } catch (const InvalidValue& error) {
        study::TrialRecord record;
        record.outcome = "invalid";
        record.message = error.what();
        keep(number, std::move(record));
      }
    }
    return std::nullopt;
  }

  void take(std::int64_t number, const std::string& line) {
    auto answer = parse_answer(line);
    if (!answer.not_written.empty()) throw Error(answer.not_written);
    keep(number, std::move(answer.record));
  }

  void keep(std::int64_t number, study::TrialRecord record) {
    const auto trial = study_.trial(number);
    record.trial = number;
    const auto& base = study_.bases[trial.base];
    record.scenario = base.name;
    record.planner = base.planner.name;
    record.values = trial.values;
    record.repeat = trial.repeat;
    if (record.outcome != "invalid")
      record.identity =
          trial_identity(to_yaml(study_.resolve(trial)), study_.kernels, trial.repeat);
    store_.add(record);
    ++summary_.done;
    summary_.failed += record.outcome == "failed" || record.outcome == "invalid";
    SweepEvent event;
    event.kind = SweepEvent::Kind::recorded;
    event.trial = number;
    event.record = &record;
    report(event);
  }

  void report(SweepEvent event) const {
    event.total = summary_.total;
    event.before = summary_.before;
    event.done = summary_.done;
    if (hooks_.on_event) hooks_.on_event(event);
  }

  const Study& study_;
  const SweepRequest& request_;
  const SweepHooks& hooks_;
  TrialStore& store_;
  std::vector<bool> done_;  ///< by trial number
  std::int64_t next_;
  std::int64_t given_ = 0;
  SweepSummary summary_;
};

}  // namespace

SweepSummary run_sweep(const Study& study, const SweepRequest& request, const SweepHooks& hooks) {
  const auto table = table_of(study);
  const auto file = store_file(request.out, request.shard, request.shards);
  prepare_sweep_folder(request.out, table, request.resume, request.force);
  const SweepLock lock(file);
  if (request.force) clear_sweep_folder(request.out);
  SweepSummary summary;
  {
    TrialStore store(file, table);
    summary = Sweep(study, request, hooks, store).run();
    store.checkpoint();
  }
  export_sweep(request.out);
  return summary;
}

}  // namespace slalom::io
