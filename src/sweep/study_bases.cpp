#include "study_bases.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <map>
#include <set>

#include "../io/config_dir.hpp"
#include "../io/overrides.hpp"
#include "../io/semantic_check.hpp"
#include "axis_values.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/vehicle/derived.hpp"

namespace slalom::sweep {
namespace fs = std::filesystem;
namespace {

/// A file and the place in the study that asks for it.
struct Reference {
  fs::path file;
  io::Place place;
};

bool is_file(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

/// The folder's own name is no pattern, whatever it is.
std::string literal(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string("*?[]\\").find(c) != std::string::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// The files a pattern stands for, in the order of their bytes: the same under every locale.
std::vector<fs::path> matching_files(const std::string& pattern, const fs::path& folder) {
  const auto whole = fs::path(pattern).is_absolute() || folder.empty()
                         ? pattern
                         : literal(folder.string()) + "/" + pattern;
  glob_t found{};
  std::vector<fs::path> files;
  if (::glob(whole.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i)
      if (is_file(found.gl_pathv[i])) files.emplace_back(found.gl_pathv[i]);
  ::globfree(&found);
  std::sort(files.begin(), files.end());
  return files;
}

class BaseReader {
 public:
  BaseReader(const io::Value& root, const fs::path& file, const std::vector<std::string>& overrides,
             io::Places& places)
      : root_(root), folder_(file.parent_path()), overrides_(overrides), places_(places) {}

  StudyBases read() {
    const auto scenarios = read_scenarios();
    const auto planners = read_planners();
    read_stated();
    bases_.scenarios.resize(scenarios.size());
    for (std::size_t i = 0; i < scenarios.size(); ++i) add_scenario(i, scenarios[i], planners);
    return std::move(bases_);
  }

 private:
  std::vector<Reference> read_scenarios() const {
    const io::Value *one = root_.find("scenario"), *several = root_.find("scenarios");
    if (one != nullptr && several != nullptr)
      throw InvalidValue(several->place.to_string(), "'scenarios' beside 'scenario'",
                         "one of the two");
    if (one != nullptr && one->kind == io::Value::Kind::sequence)
      throw InvalidValue(one->place.to_string(), one->describe(),
                         "one scenario, or the key 'scenarios' for several");
    if (one != nullptr) return {referenced("scenario", *one)};
    if (several == nullptr)
      throw InvalidValue(root_.place.to_string(), "a study without 'scenario'",
                         "the key 'scenario' or 'scenarios'");
    std::vector<Reference> found;
    for (const auto& item :
         some_items(*several, "a list of scenarios: names, files, or patterns such as 'a/*.yaml'"))
      add_matching(item, found);
    return found;
  }

  /// What one item of `scenarios:` stands for: a name, a file, or the files of a pattern.
  void add_matching(const io::Value& item, std::vector<Reference>& found) const {
    const auto& text = io::to_text(item, "the name of a scenario, a file, or a pattern");
    if (text.find_first_of("*?[") == std::string::npos || is_file(folder_ / text)) {
      found.push_back(referenced("scenario", item));
      return;
    }
    const auto files = matching_files(text, folder_);
    if (files.empty())
      throw InvalidValue(
          item.place.to_string(), fmt::format("pattern '{}'", text),
          fmt::format("one that files match (in {})", folder_.empty() ? "." : folder_.string()));
    for (const auto& file : files) found.push_back({fs::absolute(file), item.place});
  }

  /// Empty: each scenario has its own.
  std::vector<Reference> read_planners() const {
    std::vector<Reference> found;
    const io::Value* planners = root_.find("planners");
    if (planners == nullptr) return found;
    const bool is_list = planners->kind == io::Value::Kind::sequence;
    if (!is_list || planners->items.empty())
      throw InvalidValue(planners->place.to_string(), is_list ? "no planner" : planners->describe(),
                         "a list of planners");
    for (const auto& planner : planners->items) found.push_back(referenced("planner", planner));
    return found;
  }

  /// The scenario or planner file a value names, which must be there.
  Reference referenced(const std::string& what, const io::Value& value) const {
    const auto& name = io::to_text(value, fmt::format("the name of a {}, or a file", what));
    const auto file = io::find_config(what, name, folder_, value.place.to_string());
    if (!is_file(file))
      throw InvalidValue(value.place.to_string(), fmt::format("{} '{}'", what, name),
                         fmt::format("an existing file ({} is none)", file.string()));
    return {fs::absolute(file), value.place};
  }

  void add_scenario(std::size_t index, const Reference& scenario,
                    const std::vector<Reference>& planners) {
    io::ScenarioRequest request;
    request.name_or_file = scenario.file.string();
    std::set<std::string> names;
    for (std::size_t i = 0; i < std::max<std::size_t>(1, planners.size()); ++i) {
      if (!planners.empty()) request.planner = planners[i].file.string();
      bases_.all.push_back(load(request));
      // Rows of the table name their planner and scenario, so that no two may share a name.
      if (const auto& name = bases_.all.back().planner.name; !names.insert(name).second)
        throw InvalidValue(planners[i].place.to_string(),
                           fmt::format("a second planner named '{}'", name), "a name of its own");
    }
    auto& name = bases_.scenarios[index] = bases_.all.back().name;
    const auto [other, is_new] = names_.emplace(name, scenario.file);
    if (!is_new)
      throw InvalidValue(scenario.place.to_string(),
                         fmt::format("a second scenario named '{}' ({} and {})", name,
                                     other->second.string(), scenario.file.string()),
                         "a name of its own");
  }

  sim::Scenario load(const io::ScenarioRequest& request) {
    auto scenario = io::load_scenario(request);
    apply_to(bases_, scenario, [&] {
      if (const io::Value* set = root_.find("set"))
        for (const auto& member : set->members)
          io::apply_setting(member.key, member.place, member.value, scenario, places_);
      for (const auto& assignment : overrides_) io::apply_override(assignment, scenario, places_);
      io::check_goal_keys(scenario, places_);
    });
    io::follow_footprint(scenario, places_);
    scenario.goal = world::placed(scenario.goal, scenario.road.get());
    // Once, so that what one of the two states is not derived from the other.
    vehicle::derive(scenario.vehicle, {bases_.stated.begin(), bases_.stated.end()});
    return scenario;
  }

  void read_stated() {
    auto keys = overrides_;
    if (const io::Value* set = root_.find("set")) {
      io::require_map(*set, "a map from key paths to values");
      for (const auto& member : set->members) keys.push_back(member.key);
    }
    const auto stated = io::stated_of_vehicle(keys);
    bases_.stated.assign(stated.begin(), stated.end());
  }

  const io::Value& root_;
  fs::path folder_;
  const std::vector<std::string>& overrides_;
  io::Places& places_;
  StudyBases bases_;
  std::map<std::string, fs::path> names_;  ///< of scenarios, with the file of each
};

}  // namespace

StudyBases read_bases(const io::Value& root, const fs::path& file,
                      const std::vector<std::string>& overrides, io::Places& places) {
  return BaseReader(root, file, overrides, places).read();
}

}  // namespace slalom::sweep
