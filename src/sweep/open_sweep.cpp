#include "slalom/sweep/open_sweep.hpp"

#include <unordered_map>
#include <utility>
#include <vector>

#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"
#include "store_reader.hpp"
#include "sweep_files.hpp"
#include "sweep_folder.hpp"
#include "trial_message.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

/// Trials recorded as invalid one after the other, before whoever asks for the next may do
/// something else: there may be a million.
constexpr int kMostInvalid = 100;

/// What a store says of its study, and the bases it keeps.
struct Stated {
  report::SweepTable table;
  std::vector<std::string> bases;
};

Stated stated(const Study& study) {
  Stated result{{}, study.resolved_bases()};
  auto& table = result.table;
  table.name = study.name;
  table.title = study.title;
  table.identity = study.identity(result.bases);
  table.kernels = study.kernels;
  table.scenarios = study.scenarios;
  table.planners = study.planners();
  table.columns = study.columns();
  table.stated = study.stated;
  table.repeats = study.settings.repeats;
  table.size = study.size();
  return result;
}

}  // namespace

class OpenSweep::Impl {
 public:
  Impl(const Study& study, const SweepRequest& request,
       std::function<void(const SweepEvent&)> on_event)
      : Impl(study, request, std::move(on_event), stated(study)) {}

  std::optional<TrialJob> next() {
    int invalid = 0;
    for (; next_ <= study_.size(); next_ += request_.shards) {
      if (done_[static_cast<std::size_t>(next_)]) continue;
      if (request_.limit && given_ >= *request_.limit) return std::nullopt;
      if (invalid >= kMostInvalid) return TrialJob{};
      ++given_;
      const auto number = next_;
      const auto trial = study_.trial(number);
      try {
        TrialOrder order;
        order.resolved = io::to_yaml(study_.resolve(trial));
        order.kernels = study_.kernels;
        if (study_.settings.keep == Keep::drives)
          order.folder = drive_folder(request_.out, number).string();
        identities_[number] = trial_identity(order.resolved, order.kernels, trial.repeat);
        next_ += request_.shards;
        return TrialJob{number, to_line(order)};
      } catch (const InvalidValue& error) {
        report::TrialRecord record;
        record.outcome = "invalid";
        record.message = error.what();
        keep(number, std::move(record));
        ++invalid;
      }
    }
    return std::nullopt;
  }

  void record(std::int64_t number, const std::string& line) {
    auto answer = parse_answer(line);
    if (!answer.not_written.empty()) throw Error(answer.not_written);
    // A worker elsewhere may have written to a disk of its own.
    std::error_code error;
    if (const auto folder = drive_folder(request_.out, number);
        study_.settings.keep == Keep::drives && !fs::exists(folder, error))
      throw Error(folder.string() +
                  ": not to be seen here; drives are kept in a folder that all workers share");
    keep(number, std::move(answer.record));
  }

  void record_failed(std::int64_t number, const std::string& reason) {
    report::TrialRecord record;
    record.outcome = "failed";
    record.message = reason;
    keep(number, std::move(record));
  }

  SweepSummary summary() const {
    auto summary = summary_;
    summary.pending = summary.total - summary.before - summary.done;
    return summary;
  }

  void finish() {
    held_.store->checkpoint();
    export_sweep(request_.out);
  }

 private:
  Impl(const Study& study, const SweepRequest& request,
       std::function<void(const SweepEvent&)> on_event, const Stated& stated)
      : study_(study),
        request_(request),
        on_event_(std::move(on_event)),
        held_(open_store(request, stated.table, stated.bases)),
        next_(request.shard) {
    find_done();
    report({});
  }

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

  void keep(std::int64_t number, report::TrialRecord record) {
    const auto trial = study_.trial(number);
    const auto& base = study_.bases[trial.base];
    record.trial = number;
    record.scenario = base.name;
    record.planner = base.planner.name;
    record.values = trial.values;
    record.repeat = trial.repeat;
    if (auto known = identities_.extract(number)) record.identity = std::move(known.mapped());
    held_.store->add(record);
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
    if (on_event_) on_event_(event);
  }

  const Study& study_;
  const SweepRequest request_;
  std::function<void(const SweepEvent&)> on_event_;
  HeldStore held_;
  std::vector<bool> done_;  ///< by trial number, as it was at the begin
  std::unordered_map<std::int64_t, std::string> identities_;  ///< of trials that are being run
  std::int64_t next_;
  std::int64_t given_ = 0;
  SweepSummary summary_;
};

OpenSweep::OpenSweep(const Study& study, const SweepRequest& request,
                     std::function<void(const SweepEvent&)> on_event)
    : impl_(std::make_unique<Impl>(study, request, std::move(on_event))) {}

OpenSweep::~OpenSweep() = default;

std::optional<TrialJob> OpenSweep::next() {
  return impl_->next();
}
void OpenSweep::record(std::int64_t trial, const std::string& answer) {
  impl_->record(trial, answer);
}
void OpenSweep::record_failed(std::int64_t trial, const std::string& reason) {
  impl_->record_failed(trial, reason);
}
SweepSummary OpenSweep::summary() const {
  return impl_->summary();
}
void OpenSweep::finish() {
  impl_->finish();
}

}  // namespace slalom::sweep
