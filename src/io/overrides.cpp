#include "overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "document.hpp"
#include "scenario_sections.hpp"
#include "text_file.hpp"

namespace slalom::io {
namespace {

/// One assignment, split: section "obstacles.O2", key "vy".
struct Assignment {
  std::string section, key;
  std::string text;            ///< of the value, for options that are text
  std::optional<Value> value;  ///< absent: what `text` means as YAML
  Place place;                 ///< of the key
};

/// The last dot parts section and key, so that an obstacle's name may hold dots.
void split_path(const std::string& path, Assignment& a) {
  const auto dot = path.rfind('.');
  a.section = dot == std::string::npos ? "" : path.substr(0, dot);
  a.key = dot == std::string::npos ? path : path.substr(dot + 1);
}

Assignment split(const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InvalidValue("--set", fmt::format("'{}'", assignment), "key.path=value");
  const auto path = assignment.substr(0, equals);
  Assignment result;
  result.place = {"--set " + path, 0, 0};
  result.text = assignment.substr(equals + 1);
  split_path(path, result);
  return result;
}

void set_field(const Section& section, const Assignment& a, Places& places) {
  const auto* field = section.find(a.key);
  if (field != nullptr && field->info.kind == OptionKind::text) {
    // Text is taken as it stands: 'title=a: b' is no map.
    check_text(a.text, a.place.source, "text");
    field->store(a.text);
    return;
  }
  section.set(a.key, a.value ? *a.value : parse_argument(a.text, a.place.source), a.place, places);
}

void set_obstacle(const Assignment& a, sim::Scenario& scenario, Places& places) {
  const auto dot = a.section.find('.');
  const auto name = dot == std::string::npos ? a.key : a.section.substr(dot + 1);
  std::vector<std::string> names;
  for (const auto& obstacle : scenario.obstacles) names.push_back(obstacle.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) unknown_key(name, a.place, "obstacles", names);
  if (dot == std::string::npos)
    throw InvalidValue(a.place.to_string(), "no key of the obstacle", "obstacles.NAME.KEY=value");
  if (a.key == "name")
    throw InvalidValue(a.place.to_string(), "a new name", "one of x, y, r, a, b, vx, vy");
  auto& obstacle = scenario.obstacles[static_cast<std::size_t>(found - names.begin())];
  set_field(obstacle_section(obstacle, a.section), a, places);
  places[a.section] = a.place;
}

/// "loop.tex" for tex: the keys of this name with their sections.
std::vector<std::string> whole_paths(const std::string& key, sim::Scenario& scenario) {
  std::vector<std::string> paths;
  for (const auto& section : scenario_sections())
    if (section.bind != nullptr && section.bind(scenario).find(key) != nullptr)
      paths.push_back(fmt::format("{}.{}", section.name, key));
  return paths;
}

void set_top_level(const Assignment& a, sim::Scenario& scenario) {
  if (a.key == "name" || a.key == "title") {
    check_text(a.text, a.place.source, "text");
    (a.key == "name" ? scenario.name : scenario.title) = a.text;
    return;
  }
  const auto known = section_names();
  if (std::find(known.begin(), known.end(), a.key) == known.end()) {
    if (const auto paths = whole_paths(a.key, scenario); !paths.empty())
      throw InvalidValue(a.place.to_string(), fmt::format("key '{}' without its section", a.key),
                         fmt::format("{}", fmt::join(paths, " or ")));
    unknown_key(a.key, a.place, "", scenario_keys());
  }
  throw InvalidValue(a.place.to_string(), "a whole section",
                     fmt::format("one key of it, {}.KEY=value", a.key));
}

void apply(const Assignment& a, sim::Scenario& scenario, Places& places) {
  if (const auto* section = find_section(a.section)) {
    set_field(section->bind(scenario), a, places);
    places[a.section] = a.place;
    return;
  }
  if (a.section == "obstacles" || a.section.starts_with("obstacles.")) {
    set_obstacle(a, scenario, places);
  } else if (a.section.empty()) {
    set_top_level(a, scenario);
  } else {
    unknown_key(a.section, a.place, "", section_names());
  }
}

}  // namespace

void apply_override(const std::string& assignment, sim::Scenario& scenario, Places& places) {
  apply(split(assignment), scenario, places);
}

std::set<std::string> stated_of_vehicle(const std::vector<std::string>& assignments) {
  static const std::string vehicle = "vehicle.";
  std::set<std::string> stated;
  for (const auto& assignment : assignments)
    if (assignment.starts_with(vehicle))
      stated.insert(assignment.substr(vehicle.size(), assignment.find('=') - vehicle.size()));
  return stated;
}

void apply_setting(const std::string& path, const Place& place, const Value& value,
                   sim::Scenario& scenario, Places& places) {
  Assignment a;
  a.place = place;
  a.text = value.text;
  a.value = value;
  split_path(path, a);
  apply(a, scenario, places);
}

std::vector<std::string> settings_at(const std::string& path) {
  Assignment a;
  split_path(path, a);
  sim::Scenario scenario;
  world::Obstacle obstacle;
  std::optional<Section> section;
  if (const auto* found = find_section(a.section))
    section = found->bind(scenario);
  else if (a.section.starts_with("obstacles."))
    section = obstacle_section(obstacle, a.section);
  const Field* field = section ? section->find(a.key) : nullptr;
  if (field == nullptr || field->excludes.empty()) return {path};
  std::vector<std::string> paths;
  for (const auto& key : field->excludes) paths.push_back(a.section + "." + key);
  return paths;
}

std::optional<OptionInfo> option_at(const std::string& path, sim::Scenario scenario) {
  Assignment a;
  split_path(path, a);
  const auto* found = find_section(a.section);
  if (found == nullptr) return std::nullopt;
  const auto section = found->bind(scenario);
  const auto* field = section.find(a.key);
  return field != nullptr ? std::optional(field->info) : std::nullopt;
}

void try_settings(const std::string& path, const Place& place,
                  const std::vector<const Value*>& values, sim::Scenario scenario) {
  Assignment a;
  a.place = place;
  split_path(path, a);
  // Making a section takes longer than setting a value.
  std::optional<Section> section;
  if (const auto* found = find_section(a.section)) section = found->bind(scenario);
  Places places;
  for (const Value* value : values) {
    a.text = value->text;
    a.value = *value;
    if (section)
      set_field(*section, a, places);
    else
      apply(a, scenario, places);
  }
}

}  // namespace slalom::io
