#include "config_dir.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "document.hpp"
#include "slalom/base/options.hpp"

namespace slalom::io {
namespace fs = std::filesystem;
namespace {

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// Where the folder may be, in order of preference.
std::vector<fs::path> candidates() {
  std::vector<fs::path> paths;
#ifdef SLALOM_CONFIG_DIR_INSTALL
  std::error_code error;
  const auto executable = fs::read_symlink("/proc/self/exe", error);
  if (!error)  // where it is installed, and in the Python package
    for (const char* place : {SLALOM_CONFIG_DIR_INSTALL, "../config"})
      paths.push_back((executable.parent_path() / place).lexically_normal());
#endif
#ifdef SLALOM_CONFIG_DIR_BUILD
  paths.emplace_back(SLALOM_CONFIG_DIR_BUILD);
#endif
  return paths;
}

std::string title_of(const fs::path& file) {
  const Value root = parse_file(file, "a configuration file");
  const Value* title = root.find("title");
  return title != nullptr && title->kind == Value::Kind::scalar ? title->text : "";
}

}  // namespace

fs::path config_dir() {
  if (const char* chosen = std::getenv("SLALOM_CONFIG_DIR"); chosen != nullptr && *chosen != 0) {
    if (!is_folder(chosen))
      throw InvalidValue("SLALOM_CONFIG_DIR", fmt::format("'{}'", chosen), "an existing folder");
    return chosen;
  }
  std::vector<std::string> tried;
  for (const auto& path : candidates()) {
    if (is_folder(path / "scenarios")) return path;
    tried.push_back(path.string());
  }
  throw Error(fmt::format("no folder of built-in configuration (tried {}); set SLALOM_CONFIG_DIR",
                          tried.empty() ? "none" : fmt::format("{}", fmt::join(tried, ", "))));
}

std::vector<BuiltIn> built_in(const std::string& folder) {
  std::vector<BuiltIn> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(config_dir() / folder, error))
    if (entry.path().extension() == ".yaml")
      found.push_back(
          {entry.path().stem().string(), title_of(entry.path()), entry.path().string()});
  if (error)
    throw Error(fmt::format("{}: cannot be listed ({})", (config_dir() / folder).string(),
                            error.message()));
  std::sort(found.begin(), found.end(),
            [](const BuiltIn& a, const BuiltIn& b) { return a.name < b.name; });
  return found;
}

fs::path find_config(const std::string& what, const std::string& name_or_file, const fs::path& base,
                     const std::string& where) {
  const fs::path given(name_or_file);
  const bool is_path =
      given.has_parent_path() || given.extension() == ".yaml" || given.extension() == ".yml";
  auto local = given.is_absolute() || base.empty() ? given : base / given;
  if (is_path) return local;

  const auto folder = config_dir() / (what == "study" ? "studies" : what + "s");
  std::error_code error;
  if (!name_or_file.empty() && fs::exists(folder / (name_or_file + ".yaml"), error))
    return folder / (name_or_file + ".yaml");
  if (!name_or_file.empty() && fs::exists(local, error)) return local;

  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  const auto nearest = nearest_name(name_or_file, names);
  throw InvalidValue(
      where, fmt::format("{} '{}'", what, name_or_file),
      fmt::format("one of {}, or a file{}", fmt::join(names, ", "),
                  nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest)));
}

std::vector<BuiltIn> built_in_scenarios() {
  return built_in("scenarios");
}
std::vector<BuiltIn> built_in_planners() {
  return built_in("planners");
}
std::vector<BuiltIn> built_in_vehicles() {
  return built_in("vehicles");
}
std::vector<BuiltIn> built_in_studies() {
  return built_in("studies");
}

}  // namespace slalom::io
