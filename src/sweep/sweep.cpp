#include "slalom/sweep/sweep.hpp"

#include "slalom/base/error.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/sweep/open_sweep.hpp"
#include "slalom/sweep/worker_pool.hpp"

namespace slalom::sweep {
namespace {

/// The sweep's trials as a pool's jobs.
PoolHooks pool_hooks(OpenSweep& sweep, const SweepHooks& hooks,
                     const std::function<void(SweepEvent)>& report) {
  PoolHooks pool;
  pool.next = [&sweep]() -> std::optional<PoolJob> {
    auto job = sweep.next();
    if (!job) return std::nullopt;
    return PoolJob{job->trial, std::move(job->order)};
  };
  pool.started = [report](std::int64_t id, int process, int attempt) {
    SweepEvent event;
    event.kind = SweepEvent::Kind::started;
    event.trial = id;
    event.process = process;
    event.attempt = attempt;
    report(event);
  };
  pool.retried = [report](std::int64_t id, const std::string& reason) {
    SweepEvent event;
    event.kind = SweepEvent::Kind::retried;
    event.trial = id;
    event.reason = reason;
    report(event);
  };
  pool.done = [&sweep](std::int64_t id, const std::string& answer) { sweep.record(id, answer); };
  pool.failed = [&sweep](std::int64_t id, const std::string& reason) {
    sweep.record_failed(id, reason);
  };
  pool.tick = hooks.tick;
  pool.interrupted = hooks.interrupted;
  return pool;
}

}  // namespace

void check_kernels(const std::string& kernels) {
  if (!has_kernels(kernel_set(kernels)))
    throw InvalidValue("kernels", kernels,
                       std::string("an instruction set that this processor has, such as ") +
                           to_string(best_kernels()));
}

SweepSummary run_sweep(const Study& study, const SweepRequest& request, const SweepHooks& hooks) {
  check_kernels(study.kernels);  // else every trial would fail
  OpenSweep sweep(study, request, hooks.on_event);
  const auto report = [&](SweepEvent event) {
    const auto summary = sweep.summary();
    event.total = summary.total;
    event.before = summary.before;
    event.done = summary.done;
    if (hooks.on_event) hooks.on_event(event);
  };
  std::int64_t left = 0;
  auto pool = pool_hooks(sweep, hooks, report);
  pool.left = [&left](std::int64_t) { ++left; };
  const bool ended = run_pool(
      {request.worker, request.jobs, study.settings.retries, study.settings.time_limit}, pool);
  auto summary = sweep.summary();
  summary.killed = left;
  summary.interrupted = !ended;
  sweep.finish();
  return summary;
}

}  // namespace slalom::sweep
