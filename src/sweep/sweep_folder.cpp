#include "sweep_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "../io/file_set.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"
#include "store_reader.hpp"
#include "sweep_files.hpp"
#include "trials_csv.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kPart = 1 << 16;  ///< bytes of a table written at once

/// Two stores of one study state the same trials.
bool stated_alike(const report::SweepTable& a, const report::SweepTable& b) {
  return a.kernels == b.kernels && a.scenarios == b.scenarios && a.planners == b.planners &&
         a.columns == b.columns && a.stated == b.stated && a.repeats == b.repeats &&
         a.size == b.size;
}

/// The study whose results stand in a folder; its identity is empty if there are none.
report::SweepTable study_in(const fs::path& folder) {
  report::SweepTable found;
  for (const auto& file : store_files(folder)) {
    auto study = stored_study(file);
    if (study.identity.empty()) continue;
    if (!found.identity.empty() && found.identity != study.identity)
      throw InvalidValue(
          folder.string(),
          fmt::format("the results of two studies, '{}' and '{}'", found.name, study.name),
          "those of one");
    if (!found.identity.empty() && !stated_alike(found, study))
      throw InvalidValue(file.string() + ": damaged", "another study than beside it",
                         "the one that all stores of the folder state");
    found = std::move(study);
  }
  return found;
}

/// Whether the folder holds results of this very study, undamaged.
bool holds(const fs::path& folder, const report::SweepTable& study) {
  try {
    const auto found = study_in(folder);
    return found.identity == study.identity && stated_alike(found, study);
  } catch (const Error&) {
    return false;
  }
}

/// Throws Error where something stands in the folder that is no sweep's.
void refuse_foreign(const fs::path& folder, OtherFiles other_files) {
  if (const auto name = foreign_entry(folder, other_files); !name.empty())
    throw Error(
        fmt::format("{}: holds something else already ('{}'), expected an empty or new folder",
                    folder.string(), name));
}

/// Throws Error unless the folder holds nothing, or results of the same study.
void check_sweep_folder(const fs::path& folder, const report::SweepTable& study, bool resume) {
  report::SweepTable found;
  try {
    found = study_in(folder);
  } catch (const Error& error) {
    throw Error(
        fmt::format("{}; take another folder, or --force to replace what is there", error.what()));
  }
  const bool same = found.identity == study.identity;
  if (resume && !same)
    throw Error(fmt::format("{}: holds {}, so that there is nothing to resume", folder.string(),
                            found.identity.empty() ? "no sweep" : "another study"));
  if (!same && !found.identity.empty())
    throw Error(fmt::format(
        "{}: holds results of {}; take another folder, or --force to replace them", folder.string(),
        found.name == study.name ? fmt::format("study '{}' as it was before it changed", found.name)
                                 : fmt::format("another study, '{}'", found.name)));
  if (same && !found.identity.empty() && !stated_alike(found, study))
    throw Error(
        fmt::format("{}: damaged: does not state the trials of study '{}'; take another "
                    "folder, or --force to replace what is there",
                    folder.string(), study.name));
  if (!found.identity.empty()) return;
  refuse_foreign(folder, OtherFiles::count);
}

/// The one study of several folders, of which some may hold nothing but a store that was killed as
/// it was made. Throws InvalidValue where there are two, or none.
report::SweepTable common_study(const std::vector<fs::path>& folders) {
  const auto is_empty = [](const fs::path& folder) {
    return !store_files(folder).empty() && study_in(folder).identity.empty();
  };
  const auto first = std::find_if_not(folders.begin(), folders.end(), is_empty);
  if (first == folders.end()) return study_of(folders.front());
  const auto common = study_of(*first);
  for (auto folder = first + 1; folder != folders.end(); ++folder) {
    if (is_empty(*folder)) continue;
    if (const auto study = study_of(*folder); study.identity != common.identity)
      throw InvalidValue(folder->string(), fmt::format("another study, '{}'", study.name),
                         fmt::format("'{}', as in {}", common.name, first->string()));
  }
  return common;
}

fs::path lock_file(const fs::path& store) {
  return store.parent_path() / ("." + store.stem().string() + ".lock");
}

/// The shard i/n whose store is locked by `.trials-i-of-n.lock`, 1/1 for `.trials.lock`; nothing
/// for other files.
std::optional<std::pair<int, int>> shard_of(const fs::path& lock) {
  const auto name = lock.stem().string();
  if (lock.extension() != ".lock" || !name.starts_with('.')) return std::nullopt;
  return shard_of_store(name.substr(1) + ".sqlite");
}

/// Shards of a folder at which another process is at work.
using Shards = std::vector<std::pair<int, int>>;

Shards at_work(const fs::path& folder) {
  Shards found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto shard = shard_of(entry.path());
    if (shard && !io::FileLock(entry.path(), io::FileLock::Wait::no).held())
      found.push_back(*shard);
  }
  return found;
}

/// Throws Error when one of the shards has a trial of this sweep's, or is of another study.
void check_apart(const Shards& shards, const SweepRequest& request,
                 const report::SweepTable& study) {
  for (const auto& [shard, count] : shards) {
    const bool shares = (shard - request.shard) % std::gcd(count, request.shards) == 0;
    const auto store = store_file(request.out, shard, count);
    if (shares || stored_study(store).identity != study.identity)
      throw Error(fmt::format("{}: another sweep is at work on it", store.string()));
  }
}

/// What the stores of several folders keep of their study's scenarios: a store that was killed as
/// it was made has none.
std::vector<std::string> bases_in(const std::vector<fs::path>& folders) {
  for (const auto& folder : folders)
    for (const auto& file : store_files(folder))
      if (auto bases = stored_bases(file); !bases.empty()) return bases;
  return {};
}

}  // namespace

HeldStore open_store(const SweepRequest& request, const report::SweepTable& study,
                     const std::vector<std::string>& bases) {
  const auto& folder = request.out;
  std::error_code error;
  if (request.resume && !fs::exists(folder, error)) check_sweep_folder(folder, study, true);
  io::prepare_folder(folder, true);
  const io::FileLock beginning(folder, io::FileLock::Wait::yes);
  const auto working = at_work(folder);
  check_apart(working, request, study);
  // Of the same study the results of other shards stay, whether these are at work or have ended.
  const bool anew =
      request.force && working.empty() && !(request.shards > 1 && holds(folder, study));
  if (anew)
    refuse_foreign(folder, OtherFiles::pass);
  else
    check_sweep_folder(folder, study, request.resume);
  const auto file = store_file(folder, request.shard, request.shards);
  HeldStore held;
  held.lock = std::make_unique<io::FileLock>(lock_file(file), io::FileLock::Wait::no);
  if (!held.lock->held())
    throw Error(fmt::format("{}: another sweep is at work on it", file.string()));
  if (anew)
    clear_sweep(folder);
  else if (request.force)
    clear_shard(folder, request.shard, request.shards);
  held.store = std::make_unique<TrialStore>(file, study, bases);
  if (request.again_failed)
    for (const auto& store : store_files(folder))
      forget_trials(store, request.shard, request.shards, "failed");
  return held;
}

report::SweepTable study_of(const fs::path& folder) {
  auto study = study_in(folder);
  std::error_code error;
  if (study.identity.empty())
    throw InvalidValue(folder.string(),
                       fs::is_directory(folder, error) ? "no results of a sweep" : "no such folder",
                       "the folder of a sweep");
  return study;
}

report::SweepTable read_sweep(const fs::path& folder) {
  auto table = study_of(folder);
  TrialStream trials(store_files(folder));
  while (auto record = trials.next()) table.trials.push_back(std::move(*record));
  return table;
}

std::string trials_csv(const fs::path& folder) {
  const auto study = study_of(folder);
  TrialStream trials(store_files(folder));
  auto text = trials_csv_head(study);
  while (const auto record = trials.next()) text += trials_csv_row(study, *record);
  return text;
}

SweepContent export_sweep(const fs::path& folder) {
  // Of two shards that end together, the second to write must know what the first one has.
  const io::FileLock lock(folder / ".export.lock", io::FileLock::Wait::yes);
  SweepContent content{study_of(folder)};
  TrialStream trials(store_files(folder));
  auto text = trials_csv_head(content.study);
  io::FileSet files;
  files.add(folder / "trials.csv", [&] {
    while (text.size() < kPart) {
      const auto record = trials.next();
      if (!record) break;
      ++content.trials;
      text += trials_csv_row(content.study, *record);
    }
    return std::exchange(text, "");
  });
  files.commit();
  return content;
}

SweepContent merge_sweeps(const std::vector<fs::path>& from, const fs::path& out, bool force) {
  const auto study = common_study(from);
  const bool into_one_of_them = std::any_of(from.begin(), from.end(), [&](const auto& folder) {
    std::error_code error;
    return fs::equivalent(folder, out, error);
  });
  SweepRequest request;
  request.out = out;
  request.force = force && !into_one_of_them;
  const auto held = open_store(request, study, bases_in(from));
  for (const auto& folder : from) {
    TrialStream trials(store_files(folder));
    held.store->add_all(trials);
  }
  held.store->checkpoint();
  // The drives last: they take longest, and the table is whole without them.
  auto content = export_sweep(out);
  for (const auto& folder : from) copy_drives(folder, out);
  return content;
}

}  // namespace slalom::sweep
