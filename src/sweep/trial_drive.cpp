#include "slalom/sweep/trial_drive.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "../io/text_file.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sweep/study.hpp"
#include "slalom/sweep/sweep.hpp"
#include "slalom/sweep/worker_pool.hpp"
#include "store_reader.hpp"
#include "sweep_files.hpp"
#include "sweep_folder.hpp"
#include "trial_message.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

/// A trial with the store that has it.
struct Found {
  fs::path store;
  report::TrialRecord record;
};

/// Of several stores one in which the trial has not failed, where there is one.
Found find(const fs::path& folder, const report::SweepTable& study, std::int64_t number) {
  const auto expected = fmt::format("a trial from 1 to {}", study.size);
  if (number < 1 || number > study.size)
    throw InvalidValue(folder.string(), fmt::format("trial {}", number), expected);
  std::optional<Found> found;
  for (const auto& store : store_files(folder))
    if (auto record = stored_trial(store, number))
      if (!found || found->record.outcome == "failed") found = Found{store, std::move(*record)};
  if (!found)
    throw InvalidValue(folder.string(), fmt::format("trial {}, which has not run yet", number),
                       expected + " that has");
  return std::move(*found);
}

/// The resolved scenario of a trial, made certain of by its identity.
std::string resolved(const Found& found, const report::SweepTable& study) {
  const auto& record = found.record;
  const auto base =
      io::parse_scenario(stored_base(found.store, record.trial), found.store.string());
  Trial trial;
  trial.number = record.trial;
  trial.values = record.values;
  std::string text;
  try {
    text = io::to_yaml(resolve_trial(base, {study.columns, study.stated}, trial));
  } catch (const InvalidValue& error) {
    throw InvalidValue(found.store.string() + ": damaged: " + error.where(), error.found(),
                       error.expected());
  }
  if (trial_identity(text, study.kernels, record.repeat) != record.identity)
    throw InvalidValue(found.store.string(),
                       fmt::format("trial {} of another version of Slalom", record.trial),
                       "one that this version recorded");
  return text;
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Of the figures in summary.json that are not measured, those that are not as recorded.
std::string difference(const fs::path& folder, const report::TrialRecord& r) {
  constexpr std::size_t kMostBytes = 16 << 20;
  const auto file = folder / "summary.json";
  Json summary;
  try {
    summary = Json::parse(io::read_file(file, kMostBytes, "the summary of a drive"));
  } catch (const std::exception&) {
    return "its summary.json cannot be read";
  }
  std::string text;
  const auto compare = [&](const char* key, const Json& recorded) {
    const auto found = summary.is_object() ? summary.value(key, Json()) : Json();
    if (found == recorded) return;
    text += fmt::format("{}{} {}, recorded {}", text.empty() ? "" : "; ", key, found.dump(),
                        recorded.dump());
  };
  compare("outcome", r.outcome);
  if (r.outcome == "failed") return text;  // it has no figures
  compare("hit", r.hit.empty() ? Json(nullptr) : Json(r.hit));
  compare("time_s", number(r.time));
  compare("least_clearance_m", number(r.least_clearance));
  compare("least_wheel_load_N", number(r.least_wheel_load));
  compare("cycles", r.cycles);
  compare("cycles_unsolved", r.failed_cycles);
  return text;
}

bool is_kept(const fs::path& drive) {
  std::error_code error;
  return fs::exists(drive / "report.html", error);
}

/// Has one worker drive it: a crash or a hang must not be this process's. False when interrupted.
bool drive(const std::vector<std::string>& worker, double time_limit, const TrialOrder& order,
           std::int64_t number, const std::function<bool()>& interrupted) {
  bool given = false;
  std::string fault = "its process was killed";
  PoolHooks hooks;
  hooks.next = [&]() -> std::optional<PoolJob> {
    if (std::exchange(given, true)) return std::nullopt;
    return PoolJob{number, to_line(order)};
  };
  hooks.done = [&](std::int64_t, const std::string& line) {
    fault = parse_answer(line).not_written;
  };
  hooks.failed = [&](std::int64_t, const std::string& reason) { fault = reason; };
  hooks.interrupted = interrupted;
  if (!run_pool({worker, 1, 0, time_limit}, hooks)) return false;
  if (!fault.empty()) throw Error(fmt::format("trial {}: {}", number, fault));
  return true;
}

}  // namespace

std::optional<TrialDrive> kept_drive(const fs::path& folder, std::int64_t trial) {
  TrialDrive result{drive_folder(folder, trial)};
  if (!is_kept(result.folder)) return std::nullopt;
  result.difference = difference(result.folder, find(folder, study_of(folder), trial).record);
  return result;
}

TrialDrive trial_drive(const fs::path& folder, std::int64_t number,
                       const std::vector<std::string>& worker,
                       const std::function<bool()>& interrupted) {
  const auto study = study_of(folder);
  const auto found = find(folder, study, number);
  if (auto kept = kept_drive(folder, number)) return *kept;
  if (found.record.outcome == "invalid")
    throw InvalidValue(folder.string(), fmt::format("trial {}, which is invalid", number),
                       "one that could be driven: " + found.record.message);
  check_kernels(study.kernels);
  TrialDrive result{drive_folder(folder, number)};
  result.again = true;
  // One that came to its end when it was recorded does so again.
  const double limit = found.record.outcome == "failed" ? StudySettings{}.time_limit
                                                        : std::numeric_limits<double>::infinity();
  const TrialOrder order{resolved(found, study), study.kernels, result.folder.string()};
  result.interrupted = !drive(worker, limit, order, number, interrupted);
  if (!result.interrupted) result.difference = difference(result.folder, found.record);
  return result;
}

}  // namespace slalom::sweep
