#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/tuple.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "binding.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/sweep/open_sweep.hpp"
#include "slalom/sweep/sweep.hpp"
#include "slalom/sweep/worker_pool.hpp"

namespace slalom::python {
namespace {

using Path = std::filesystem::path;

/// What Python knows as OpenSweep: with its study.
class Sweep {
 public:
  Sweep(const std::string& study, const Path& out, const std::vector<std::string>& set,
        std::optional<std::int64_t> limit, bool resume, bool force, bool again_failed)
      : study_(sweep::load_study(study, set)) {
    sweep::SweepRequest request;
    request.out = std::filesystem::absolute(out);  // also where other machines keep drives
    request.limit = limit;
    request.resume = resume;
    request.force = force;
    request.again_failed = again_failed;
    sweep_ = std::make_unique<sweep::OpenSweep>(study_, request);
  }

  const sweep::Study& study() const { return study_; }
  sweep::OpenSweep& sweep() const { return *sweep_; }

 private:
  sweep::Study study_;
  std::unique_ptr<sweep::OpenSweep> sweep_;
};

/// A trial, its answer (None: it failed), and why it failed.
using Result = std::tuple<std::int64_t, std::optional<std::string>, std::string>;
using Orders = std::vector<std::pair<std::int64_t, std::string>>;

std::vector<Result> run_trials(const Orders& orders, const std::vector<std::string>& worker,
                               int retries, double time_limit, double seconds) {
  std::vector<Result> results;
  Released released;
  {
    const nb::gil_scoped_release unlock;
    const Timer timer;
    std::size_t next = 0;
    sweep::PoolHooks hooks;
    hooks.next = [&]() -> std::optional<sweep::PoolJob> {
      if (next == orders.size() || (next > 0 && timer.wall() > seconds)) return std::nullopt;
      const auto& [trial, order] = orders[next++];
      return sweep::PoolJob{trial, order};
    };
    hooks.done = [&](std::int64_t trial, const std::string& answer) {
      results.emplace_back(trial, answer, "");
    };
    hooks.failed = [&](std::int64_t trial, const std::string& reason) {
      results.emplace_back(trial, std::nullopt, reason);
    };
    hooks.interrupted = [&] { return released.interrupted(); };
    (void)sweep::run_pool({worker, 1, retries, time_limit}, hooks);
  }
  released.raise_if_interrupted();
  return results;
}

void require_kernels(const std::string& name) {
  const auto before = current_kernels();
  select_kernels(kernel_set(name));  // throws where the processor lacks it
  select_kernels(before);
}

void bind_open_sweep(nb::module_& module) {
  nb::class_<Sweep>(module, "OpenSweep", doc::sweep_OpenSweep)
      .def(nb::init<const std::string&, const Path&, const std::vector<std::string>&,
                    std::optional<std::int64_t>, bool, bool, bool>(),
           "study"_a, "out"_a, nb::kw_only(), "set"_a = std::vector<std::string>(),
           "limit"_a = nb::none(), "resume"_a = false, "force"_a = false, "again_failed"_a = false)
      .def_prop_ro("name", [](const Sweep& s) { return s.study().name; })
      .def_prop_ro("kernels", [](const Sweep& s) { return s.study().kernels; })
      .def_prop_ro("retries", [](const Sweep& s) { return s.study().settings.retries; })
      .def_prop_ro("time_limit", [](const Sweep& s) { return s.study().settings.time_limit; })
      .def(
          "next",
          [](const Sweep& s) -> std::optional<std::pair<std::int64_t, std::string>> {
            auto job = s.sweep().next();
            for (; job && job->trial == 0; job = s.sweep().next())
              if (PyErr_CheckSignals() != 0) throw nb::python_error();
            if (!job) return std::nullopt;
            return std::pair(job->trial, std::move(job->order));
          },
          doc::sweep_OpenSweep_next)
      .def(
          "record",
          [](const Sweep& s, std::int64_t trial, const std::string& answer) {
            s.sweep().record(trial, answer);
          },
          "trial"_a, "answer"_a, doc::sweep_OpenSweep_record)
      .def(
          "record_failed",
          [](const Sweep& s, std::int64_t trial, const std::string& reason) {
            s.sweep().record_failed(trial, reason);
          },
          "trial"_a, "reason"_a, doc::sweep_OpenSweep_record_failed)
      .def_prop_ro(
          "total", [](const Sweep& s) { return s.sweep().summary().total; },
          doc::sweep_SweepSummary_total)
      .def_prop_ro(
          "before", [](const Sweep& s) { return s.sweep().summary().before; },
          doc::sweep_SweepSummary_before)
      .def_prop_ro(
          "done", [](const Sweep& s) { return s.sweep().summary().done; },
          doc::sweep_SweepSummary_done)
      .def_prop_ro(
          "failed", [](const Sweep& s) { return s.sweep().summary().failed; },
          doc::sweep_SweepSummary_failed)
      .def_prop_ro(
          "pending", [](const Sweep& s) { return s.sweep().summary().pending; },
          doc::sweep_SweepSummary_pending)
      .def(
          "finish", [](const Sweep& s) { s.sweep().finish(); }, doc::sweep_OpenSweep_finish);
}

}  // namespace

void bind_sweep(nb::module_& module) {
  bind_open_sweep(module);
  module.def(
      "trials_csv", [](const Path& folder) { return sweep::trials_csv(folder); }, "folder"_a,
      doc::sweep_trials_csv);
  module.def(
      "run_trials", &run_trials, "orders"_a, "worker"_a, "retries"_a, "time_limit"_a, "seconds"_a,
      "Runs trials one after the other on a worker process, whose command is given: one that "
      "calls\nserve_trials. Trials that have not begun after so many seconds are left out, and "
      "those whose processes\nothers kill. Returns of each trial its answer, or None and why it "
      "failed.");
  module.def(
      "serve_trials",
      [] {
        const nb::gil_scoped_release unlock;
        sweep::serve_trials();
      },
      doc::sweep_serve_trials);
  module.def("require_kernels", &require_kernels, "name"_a,
             "Raises Error where this processor lacks an instruction set.");
}

}  // namespace slalom::python
