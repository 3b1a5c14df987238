#include "sweep_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "../io/file_set.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"
#include "trial_store.hpp"
#include "trials_csv.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kPart = 1 << 16;  ///< bytes of a table written at once

/// The identity of the study whose results stand in a folder; empty if there are none.
report::SweepTable study_in(const fs::path& folder) {
  report::SweepTable found;
  for (const auto& file : store_files(folder)) {
    auto study = stored_study(file);
    if (study.identity.empty()) continue;
    if (!found.identity.empty() && found.identity != study.identity)
      throw Error(fmt::format("{}: holds the results of two studies, '{}' and '{}'",
                              folder.string(), found.name, study.name));
    found = std::move(study);
  }
  return found;
}

/// Whether a sweep may have left a file of this name.
bool is_ours(const fs::path& file) {
  const auto name = file.filename().string();
  return name == "trials.csv" || name == "index.html" || name == "figures" || name == "drives" ||
         (name.starts_with("trials") && name.find(".sqlite") != std::string::npos) ||
         name.ends_with(".lock") || name.ends_with(".aside");
}

/// A name in the folder that no sweep left there; empty if there is none.
std::string foreign_entry(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (!is_ours(entry.path())) return entry.path().filename().string();
  return "";
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
  if (!found.identity.empty()) return;
  if (const auto name = foreign_entry(folder); !name.empty())
    throw Error(
        fmt::format("{}: holds something else already ('{}'), expected an empty or new folder",
                    folder.string(), name));
}

/// The one study of several folders.
report::SweepTable common_study(const std::vector<fs::path>& folders) {
  const auto first = study_of(folders.front());
  for (const auto& folder : folders)
    if (const auto study = study_of(folder); study.identity != first.identity)
      throw Error(fmt::format("{}: holds another study ('{}') than {} ('{}')", folder.string(),
                              study.name, folders.front().string(), first.name));
  return first;
}

/// Copies the kept drives that `out` does not have.
void copy_drives(const fs::path& folder, const fs::path& out) {
  std::error_code error;
  if (!fs::exists(folder / "drives", error) || fs::equivalent(folder, out, error)) return;
  fs::copy(folder / "drives", out / "drives",
           fs::copy_options::recursive | fs::copy_options::skip_existing, error);
  if (error) throw Error(fmt::format("{}: {}", (out / "drives").string(), error.message()));
}

}  // namespace

void prepare_sweep_folder(const fs::path& folder, const report::SweepTable& study, bool resume,
                          bool force) {
  if (!force) check_sweep_folder(folder, study, resume);
  io::prepare_folder(folder, true);
}

void clear_sweep_folder(const fs::path& folder) {
  std::vector<fs::path> ours;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_ours(entry.path()) && entry.path().extension() != ".lock") ours.push_back(entry.path());
  for (const auto& path : ours) {
    std::error_code error;
    fs::remove_all(path, error);
    if (error) throw Error(fmt::format("{}: {}", path.string(), error.message()));
  }
}

SweepLock::SweepLock(const fs::path& store)
    : lock_(store.parent_path() / ("." + store.stem().string() + ".lock"), io::FileLock::Wait::no) {
  if (!lock_.held()) throw Error(fmt::format("{}: another sweep is at work on it", store.string()));
}

report::SweepTable study_of(const fs::path& folder) {
  auto study = study_in(folder);
  std::error_code error;
  if (study.identity.empty())
    throw Error(fmt::format("{}: holds no results of a sweep{}", folder.string(),
                            fs::is_directory(folder, error) ? "" : " (no such folder)"));
  return study;
}

fs::path drive_folder(const fs::path& folder, std::int64_t trial) {
  return folder / "drives" / fmt::format("{:06}", trial);
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
  prepare_sweep_folder(out, study, false, force && !into_one_of_them);
  const auto file = store_file(out, 1, 1);
  const SweepLock lock(file);
  if (force && !into_one_of_them) clear_sweep_folder(out);
  {
    TrialStore store(file, study);
    store.keep_bases(stored_bases(store_files(from.front()).front()));
    for (const auto& folder : from) {
      TrialStream trials(store_files(folder));
      store.add_all(trials);
    }
    store.checkpoint();
  }
  for (const auto& folder : from) copy_drives(folder, out);
  return export_sweep(out);
}

}  // namespace slalom::sweep
