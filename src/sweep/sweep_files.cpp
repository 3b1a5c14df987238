#include "sweep_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "../io/file_set.hpp"
#include "slalom/base/error.hpp"
#include "trial_store.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kPart = 1 << 16;  ///< bytes copied at once
/// What SQLite keeps beside a store.
constexpr const char* kBesideStores[] = {"-wal", "-shm", "-journal"};

/// Names of a folder, or none where there is no such folder.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

bool is_of_store(const std::string& name) {
  if (shard_of_store(name)) return true;
  return std::any_of(std::begin(kBesideStores), std::end(kBesideStores), [&](const char* end) {
    return name.ends_with(end) &&
           shard_of_store(name.substr(0, name.size() - std::string_view(end).size()));
  });
}

/// Locks, and files that a killed run left aside.
bool is_of_work(const std::string& name) {
  return name.starts_with('.') && (name.ends_with(".lock") || name.ends_with(".aside"));
}

bool is_of_results(const std::string& name) {
  return name == "drives" || name == "figures" || name == "index.html" || name == "trials.csv";
}

/// The trial whose drive a folder of this name is.
std::optional<std::int64_t> trial_of(const std::string& name) {
  constexpr std::size_t kMostDigits = 9;
  if (name.empty() || name.size() > kMostDigits ||
      name.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return std::atoll(name.c_str());
}

bool is_figure(const std::string& name) {
  return name.ends_with(".svg") && !name.starts_with('.');
}

void remove_tree(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) throw Error(fmt::format("{}: {}", path.string(), error.message()));
}

/// Removes those entries of a folder that are ours, and the folder if nothing else is in it. Of a
/// link only the link: what is elsewhere is not in the sweep's folder.
void clear_folder(const fs::path& folder, const std::function<bool(const std::string&)>& is_ours) {
  std::error_code error;
  if (fs::is_symlink(folder, error)) return remove_tree(folder);
  if (!fs::is_directory(folder, error)) return;
  for (const auto& name : names_in(folder))
    if (is_ours(name) || is_of_work(name)) remove_tree(folder / name);
  fs::remove(folder, error);  // fails where there is more
}

/// Adds a file's content; false where the file has vanished.
bool add_copy(const fs::path& from, const fs::path& to, io::FileSet& files) {
  std::ifstream content(from, std::ios::binary);
  if (!content) return false;
  files.add(to, [&] {
    std::string part(kPart, '\0');
    content.read(part.data(), kPart);
    part.resize(static_cast<std::size_t>(content.gcount()));
    if (content.bad()) throw Error(from.string() + ": cannot be read");
    return part;
  });
  return true;
}

/// The page is last: a drive is there when its page is.
void copy_drive(const fs::path& from, const fs::path& to) {
  constexpr const char* page = "report.html";
  std::error_code error;
  if (fs::exists(to / page, error) || !fs::exists(from / page, error)) return;
  io::FileSet files;
  for (const auto& name : names_in(from)) {
    if (name.starts_with('.') || name == page) continue;
    if (!fs::is_directory(from / name, error)) {
      (void)add_copy(from / name, to / name, files);
      continue;
    }
    for (const auto& figure : names_in(from / name))
      if (is_figure(figure)) (void)add_copy(from / name / figure, to / name / figure, files);
  }
  if (add_copy(from / page, to / page, files)) files.commit();
}

}  // namespace

fs::path drive_folder(const fs::path& folder, std::int64_t trial) {
  return folder / "drives" / fmt::format("{:06}", trial);
}

std::string foreign_entry(const fs::path& folder, OtherFiles other_files) {
  const bool held = !store_files(folder).empty();
  for (const auto& name : names_in(folder)) {
    const bool passes = is_of_results(name) ? held
                                            : other_files == OtherFiles::pass ||
                                                  is_of_store(name) || is_of_work(name);
    if (!passes) return name;
  }
  return "";
}

void clear_sweep(const fs::path& folder) {
  const auto stores = store_files(folder);
  if (stores.empty()) return;
  clear_folder(folder / "drives", [](const auto& name) { return trial_of(name).has_value(); });
  clear_folder(folder / "figures", is_figure);
  for (const char* name : {"index.html", "trials.csv"}) remove_tree(folder / name);
  for (const auto& store : stores) {
    for (const char* end : kBesideStores) remove_tree(store.string() + end);
    remove_tree(store);
  }
}

void clear_shard(const fs::path& folder, int shard, int shards) {
  for (const auto& name : names_in(folder / "drives"))
    if (const auto trial = trial_of(name); trial && (*trial - shard) % shards == 0)
      remove_tree(folder / "drives" / name);
  for (const auto& store : store_files(folder)) forget_trials(store, shard, shards);
}

void copy_drives(const fs::path& folder, const fs::path& out) {
  std::error_code error;
  if (fs::equivalent(folder, out, error)) return;
  for (const auto& name : names_in(folder / "drives"))
    if (trial_of(name)) copy_drive(folder / "drives" / name, out / "drives" / name);
}

}  // namespace slalom::sweep
