#include "slalom/io/scenario_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "config_dir.hpp"
#include "document.hpp"
#include "obstacle_reader.hpp"
#include "overrides.hpp"
#include "road_reader.hpp"
#include "scenario_sections.hpp"
#include "semantic_check.hpp"
#include "slalom/sim/advice.hpp"
#include "slalom/vehicle/derived.hpp"

namespace slalom::io {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxObstacles = 1000;
constexpr int kMaxBases = 8;
/// Numbers of tables at most, so that a written scenario can be read again: so many values and
/// bytes that enough is left of what a document may have for all else.
constexpr std::size_t kMaxNumbers = kMaxNodes - 50000;

/// Of what a scenario has from tables, as values of a written scenario: each row a value too.
std::size_t numbers_in_tables(const sim::Scenario& scenario) {
  std::size_t numbers = scenario.loop.solve_times.size();
  if (scenario.road) {
    numbers += 5 * scenario.road->points().size();
    for (const auto& lane : scenario.road->lanes()) numbers += 3 * lane.size();
  }
  for (const auto& obstacle : scenario.obstacles) {
    const auto* motion = obstacle.trajectory.get();
    if (const auto* table = dynamic_cast<const world::TableTrajectory*>(motion))
      numbers += 5 * table->rows().size();
    if (const auto* path = dynamic_cast<const world::PathTrajectory*>(motion))
      numbers += 3 * path->points().size();
  }
  return numbers;
}

/// Reads one scenario file and what it refers to.
class Loader {
 public:
  Loader(const ScenarioRequest& request, fs::path file, Value root)
      : request_(request), file_(std::move(file)), root_(std::move(root)) {}

  sim::Scenario load() {
    require_map(root_, "a scenario (a map with start, goal, ...)");
    const auto known = scenario_keys();
    for (const auto& member : root_.members)
      if (std::find(known.begin(), known.end(), member.key) == known.end())
        unknown_key(member.key, member.place, "", known);

    read_names();
    for (const auto& section : scenario_sections()) read_section(section);
    apply_command_line();
    scenario_.sm_crash_follows = true;
    follow_footprint(scenario_, places_);
    check_goal_keys(scenario_, places_);
    scenario_.goal = world::placed(scenario_.goal, scenario_.road.get());
    if (const auto numbers = numbers_in_tables(scenario_); numbers > kMaxNumbers)
      throw InvalidValue(file_.string(), fmt::format("tables of {} numbers together", numbers),
                         fmt::format("at most {}, which resolved.yaml can hold", kMaxNumbers));
    check_scenario(scenario_, {file_.string(), 1, 1}, places_);
    return std::move(scenario_);
  }

  /// What a vehicle that states some settings has from elsewhere, in a sentence each.
  std::vector<std::string> of_vehicle() const {
    std::vector<std::string> sentences;
    // Limits of one's own make no other vehicle.
    const auto body = {"m", "Izz", "la", "lb", "h", "track", "FzF0", "FzR0"};
    if (std::none_of(body.begin(), body.end(),
                     [&](const char* name) { return own_.count(name) > 0; }))
      return sentences;
    if (!derived_.empty())
      sentences.push_back(
          fmt::format("of the vehicle, {} follow from what is stated", fmt::join(derived_, ", ")));
    std::vector<std::string> taken;
    for (const auto& entry : vehicle::parameter_options().entries())
      if (entry.info.name != "name" && own_.count(entry.info.name) == 0 &&
          derived_.count(entry.info.name) == 0)
        taken.push_back(entry.info.name);
    if (!taken.empty())
      sentences.push_back(fmt::format("of the vehicle, these are those of {}: {}", base_vehicle_,
                                      fmt::join(taken, ", ")));
    return sentences;
  }

 private:
  void read_names() {
    scenario_.name = file_.stem().string();
    if (const Value* name = root_.find("name")) scenario_.name = to_text(*name, "a name");
    if (const Value* title = root_.find("title")) scenario_.title = to_text(*title, "a title");
  }

  /// The vehicle or planner file that stands at `where`, which must be there.
  static fs::path referenced(const std::string& what, const std::string& name, const fs::path& base,
                             const std::string& where) {
    const auto file = find_config(what, name, base, where);
    std::error_code error;
    if (fs::status(file, error).type() == fs::file_type::not_found)
      throw InvalidValue(where, fmt::format("{} '{}'", what, name),
                         fmt::format("an existing file ({} is none)", file.string()));
    return file;
  }

  void read_section(const ScenarioSection& section) {
    if (!section.required.empty()) require_key(root_, "a scenario", section.name);
    const Value* value = root_.find(section.name);
    if (section.in_files) {
      // --planner and --vehicle put another file in the place of the one that the scenario names.
      read_over_file(section, value,
                     section.name == "planner" ? request_.planner : request_.vehicle);
    } else if (value != nullptr && section.form == ScenarioSection::Form::list) {
      read_obstacles(*value);
    } else if (value != nullptr && section.form == ScenarioSection::Form::road) {
      if (value->kind == Value::Kind::null) return;
      scenario_.road = read_road(*value);
      places_[section.name] = value->place;
    } else if (value != nullptr) {
      require_map(*value, fmt::format("the map of {}", section.name));
      require_keys(section, *value);
      section.bind(scenario_).read(*value, places_);
      places_[section.name] = value->place;
    }
  }

  static void require_keys(const ScenarioSection& section, const Value& map) {
    std::vector<std::string> said;
    for (const auto& key : section.instead)
      if (map.find(key) != nullptr) said.push_back(key);
    const std::size_t instead = said.size();
    for (const auto& key : section.required) {
      if (instead == 0) require_key(map, section.name, key);
      if (map.find(key) != nullptr) said.push_back(key);
    }
    if (instead > 0 && said.size() > 1)
      throw InvalidValue(map.place.to_string(),
                         fmt::format("a {} with {}", section.name, fmt::join(said, " and ")),
                         fmt::format("{}, or one of {}", fmt::join(section.required, " and "),
                                     fmt::join(section.instead, ", ")));
    for (const auto& key : section.beside)
      if (instead > 0 && map.find(key) != nullptr)
        throw InvalidValue(
            map.place.to_string(), fmt::format("{} beside {}", key, said[0]),
            fmt::format("{} only with {}", key, fmt::join(section.required, " and ")));
  }

  /// Reads a section's file over the defaults, or over the file that it names as its base.
  void read_file_of(const ScenarioSection& section, const fs::path& file, int depth = 0) {
    const auto what = "a " + section.name;
    const Value map = parse_file(file, what);
    require_map(map, fmt::format("{} (a map of its settings)", what));
    const Value* base = map.find("base");
    if (base != nullptr) {
      const auto place = base->place.to_string();
      if (depth == kMaxBases)
        throw InvalidValue(place, fmt::format("more than {} files, each over another", kMaxBases),
                           "fewer, and none over itself");
      to_text(*base, fmt::format("the name of a {} or a file", section.name));
      read_file_of(section, referenced(section.name, base->text, file.parent_path(), place),
                   depth + 1);
    }
    const auto settings = section.bind(scenario_);
    const Value* name = map.find("name");
    settings.find("name")->store(name != nullptr ? to_text(*name, "a name") : file.stem().string());
    if (const Value* title = map.find("title")) to_text(*title, "a title");
    settings.read(map, places_, {"name", "title", "base"});
    if (section.name != "vehicle") return;
    derive(stated_in(map));
    if (base != nullptr) return;
    // A whole file states its vehicle; what is stated over it is what differs.
    base_vehicle_ = file.stem().string();
    own_.clear();
    derived_.clear();
  }

  static std::set<std::string> stated_in(const Value& map) {
    std::set<std::string> stated;
    for (const auto& member : map.members) stated.insert(member.key);
    return stated;
  }

  /// What follows from the vehicle's settings that a map or the command line states.
  void derive(const std::set<std::string>& stated) {
    for (auto& name : vehicle::derive(scenario_.vehicle, stated)) derived_.insert(name);
    own_.insert(stated.begin(), stated.end());
  }

  /// Reads `vehicle:` or `planner:`, a name or a map with the base and what differs from it.
  /// `chosen` (from the command line) takes the base's place.
  void read_over_file(const ScenarioSection& section, const Value* value,
                      const std::optional<std::string>& chosen) {
    const auto& what = section.name;
    const bool is_map = value != nullptr && value->kind == Value::Kind::map;
    const Value* base = is_map ? value->find("base") : value;
    if (base != nullptr)
      to_text(*base, fmt::format("the name of a {}, a file, or a map of its settings", what));
    if (base != nullptr && !chosen)
      read_file_of(section,
                   referenced(what, base->text, file_.parent_path(), base->place.to_string()));
    const auto read_chosen = [&] {
      read_file_of(section, referenced(what, *chosen, "", "--" + what));
    };
    if (base != nullptr && chosen) read_chosen();
    if (is_map) {
      const auto settings = section.bind(scenario_);
      settings.read(*value, places_, {"base", "name"});
      if (what == "vehicle") derive(stated_in(*value));
      if (const Value* name = value->find("name"); name != nullptr && !(base && chosen))
        settings.find("name")->store(to_text(*name, "a name"));
    }
    // A map without a base states every setting; what the chosen file states then wins over it.
    if (base != nullptr || !chosen) return;
    if (is_map && what == "planner") forget_named_planner(section);
    read_chosen();
  }

  /// A map that states every setting, as resolved files have it, repeats what the file of the
  /// planner that it names states. This goes with that planner when another is chosen.
  void forget_named_planner(const ScenarioSection& section) {
    const auto planners = built_in_planners();
    const auto named = std::find_if(planners.begin(), planners.end(), [&](const BuiltIn& planner) {
      return planner.name == scenario_.planner.name;
    });
    if (named == planners.end()) return;
    const auto places = places_;
    const auto stated = std::exchange(scenario_.planner, {});
    read_file_of(section, named->path);
    const auto file = std::exchange(scenario_.planner, stated);
    places_ = places;
    const planner::Settings plain;
    for (const auto& setting : planner::setting_options().entries())
      if (setting.get(stated) == setting.get(file))
        setting.set(scenario_.planner, setting.get(plain));
  }

  void read_obstacles(const Value& list) {
    if (list.kind == Value::Kind::null) return;
    if (list.kind != Value::Kind::sequence)
      throw InvalidValue(list.place.to_string(), list.describe(), "a list of obstacles");
    for (const auto& item : list.items)
      for (const auto& obstacle : io::read_obstacles(item, scenario_.obstacles.size() + 1))
        add_obstacle(obstacle, item.place);
  }

  void add_obstacle(const world::Obstacle& obstacle, const Place& place) {
    if (obstacle.name.empty())
      throw InvalidValue(place.to_string(), "an obstacle with an empty name", "a name");
    if (!names_.insert(obstacle.name).second)
      throw InvalidValue(place.to_string(),
                         fmt::format("a second obstacle named '{}'", obstacle.name),
                         "a name of its own");
    if (scenario_.obstacles.size() >= kMaxObstacles)
      throw InvalidValue(place.to_string(), fmt::format("more than {} obstacles", kMaxObstacles),
                         "fewer");
    scenario_.obstacles.push_back(obstacle);
    places_["obstacles." + obstacle.name] = place;
  }

  void apply_command_line() {
    if (request_.tex) {
      Value value;
      value.kind = Value::Kind::scalar;
      value.text = fmt::format("{}", *request_.tex);
      value.place = {"--tex", 0, 0};
      apply_setting("loop.tex", value.place, value, scenario_, places_);
    }
    for (const auto& assignment : request_.overrides)
      apply_override(assignment, scenario_, places_);
    derive(stated_of_vehicle(request_.overrides));
  }

  const ScenarioRequest& request_;
  fs::path file_;
  Value root_;
  sim::Scenario scenario_;
  Places places_;
  std::set<std::string> names_;
  std::string base_vehicle_ = "hmmwv";
  std::set<std::string> own_,
      derived_;  ///< of the vehicle, stated beside its file, and that follow
};

}  // namespace

sim::Scenario load_scenario(const ScenarioRequest& request) {
  const auto file = find_config("scenario", request.name_or_file, "", "SCENARIO");
  return Loader(request, file, parse_file(file, "a scenario")).load();
}

sim::Scenario load_scenario(const ScenarioRequest& request, std::vector<std::string>& advice) {
  const auto file = find_config("scenario", request.name_or_file, "", "SCENARIO");
  Loader loader(request, file, parse_file(file, "a scenario"));
  auto scenario = loader.load();
  advice = loader.of_vehicle();
  for (auto& sentence : sim::advice(scenario)) advice.push_back(std::move(sentence));
  return scenario;
}

sim::Scenario parse_scenario(const std::string& text, const std::string& source) {
  return parse_scenario(text, {source, std::nullopt, std::nullopt, {}});
}

sim::Scenario parse_scenario(const std::string& text, const ScenarioRequest& request) {
  const auto& source = request.name_or_file;
  return Loader(request, source, parse_text(text, source, "a scenario")).load();
}

world::Obstacle parse_obstacle(const std::string& text, const std::string& source) {
  auto obstacles = read_obstacles(parse_argument(text, source), 1);
  if (obstacles.size() != 1)
    throw InvalidValue(source, fmt::format("repeat = {}", obstacles.size()), "one obstacle");
  return std::move(obstacles[0]);
}

}  // namespace slalom::io
