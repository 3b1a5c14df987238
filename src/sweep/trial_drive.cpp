#include "slalom/sweep/trial_drive.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sweep/study.hpp"
#include "store_reader.hpp"
#include "sweep_folder.hpp"
#include "trial_message.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

/// A trial with the store that has it.
struct Found {
  fs::path store;
  report::TrialRecord record;
};

Found find(const fs::path& folder, const report::SweepTable& study, std::int64_t number) {
  const auto expected = fmt::format("a trial from 1 to {}", study.size);
  if (number < 1 || number > study.size)
    throw InvalidValue(folder.string(), fmt::format("trial {}", number), expected);
  for (const auto& store : store_files(folder))
    if (auto record = stored_trial(store, number)) return {store, std::move(*record)};
  throw InvalidValue(folder.string(), fmt::format("trial {}, which has not run yet", number),
                     expected + " that has");
}

/// The resolved scenario of a trial, made certain of by its identity.
std::string resolved(const Found& found, const report::SweepTable& study) {
  const auto& record = found.record;
  const auto base =
      io::parse_scenario(stored_base(found.store, record.trial), found.store.string());
  std::string text;
  try {
    text = io::to_yaml(resolve_trial(base, study.columns, record.values, record.trial));
  } catch (const InvalidValue& error) {
    throw InvalidValue(found.store.string() + ": damaged: " + error.where(), error.found(),
                       error.expected());
  }
  if (trial_identity(text, study.kernels, record.repeat) != record.identity)
    throw Error(fmt::format("{}: trial {} was recorded by another version of Slalom",
                            found.store.string(), record.trial));
  return text;
}

/// Two drives that ended alike, in all that is not measured.
bool alike(const report::TrialRecord& a, const report::TrialRecord& b) {
  const auto same = [](double x, double y) { return x == y || (x != x && y != y); };
  return a.outcome == b.outcome && a.hit == b.hit && a.cycles == b.cycles &&
         a.failed_cycles == b.failed_cycles && a.iterations == b.iterations &&
         same(a.time, b.time) && same(a.least_clearance, b.least_clearance) &&
         same(a.least_wheel_load, b.least_wheel_load);
}

}  // namespace

TrialDrive trial_drive(const fs::path& folder, std::int64_t number,
                       const std::function<bool()>& interrupted) {
  const auto study = study_of(folder);
  TrialDrive result{drive_folder(folder, number)};
  const auto found = find(folder, study, number);
  std::error_code error;
  if (fs::exists(result.folder / "report.html", error)) return result;
  if (found.record.outcome == "invalid")
    throw InvalidValue(folder.string(), fmt::format("trial {}, which is invalid", number),
                       "one that could be driven: " + found.record.message);
  const auto answer =
      run_trial({resolved(found, study), study.kernels, result.folder.string()}, interrupted);
  if (!answer.not_written.empty()) throw Error(answer.not_written);
  result.again = true;
  result.interrupted = answer.record.outcome == sim::to_string(sim::Outcome::interrupted);
  result.as_recorded = found.record.outcome == "failed" || alike(answer.record, found.record);
  return result;
}

}  // namespace slalom::sweep
