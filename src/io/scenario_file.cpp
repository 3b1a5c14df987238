#include "slalom/io/scenario_file.hpp"

#include <fmt/format.h>

#include <set>

#include "config_dir.hpp"
#include "document.hpp"
#include "overrides.hpp"
#include "scenario_tables.hpp"
#include "section.hpp"
#include "semantic_check.hpp"

namespace slalom::io {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxObstacles = 1000;

/// Throws InvalidValue unless `map` has `key`.
void require_key(const Value& map, const std::string& path, const std::string& key) {
  if (map.find(key) == nullptr)
    throw InvalidValue(map.place.to_string(), fmt::format("{} without '{}'", path, key),
                       fmt::format("the key '{}'", key));
}

/// Reads one scenario file and what it refers to.
class Loader {
 public:
  Loader(const ScenarioRequest& request, fs::path file, Value root)
      : request_(request), file_(std::move(file)), root_(std::move(root)) {}

  sim::Scenario load() {
    require_map(root_, "a scenario (a map with start, goal, ...)");
    static const std::vector<std::string> known = {"name",  "title", "vehicle", "planner",
                                                   "start", "goal",  "region",  "obstacles",
                                                   "loop",  "plant", "sensing"};
    for (const auto& member : root_.members)
      if (std::find(known.begin(), known.end(), member.key) == known.end())
        unknown_key(member.key, member.place, "", known);

    read_names();
    read_vehicle();
    read_planner();
    read_start_goal_region();
    if (const Value* obstacles = root_.find("obstacles")) read_obstacles(*obstacles);
    read_plain("loop", sim::loop_options(), scenario_.loop);
    read_plain("plant", sim::plant_options(), scenario_.plant);
    read_plain("sensing", sim::sensing_options(), scenario_.sensing);
    apply_command_line();
    check_scenario(scenario_, file_.string(), places_);
    return std::move(scenario_);
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

  /// Reads a vehicle or planner file over the struct's defaults.
  template <class S>
  void read_base(const std::string& what, const fs::path& file, const OptionTable<S>& table,
                 S& settings) {
    const Value map = parse_file(file, "a " + what);
    require_map(map, fmt::format("a {} (a map of its settings)", what));
    settings.name = file.stem().string();
    if (const Value* name = map.find("name")) settings.name = to_text(*name, "a name");
    if (const Value* title = map.find("title")) to_text(*title, "a title");
    Section(what).add(table, settings).read(map, places_, {"name", "title"});
  }

  /// Reads `vehicle:` or `planner:`, a name or a map with the base and what differs from it.
  /// `chosen` (from the command line) takes the base's place.
  template <class S>
  void read_based(const std::string& what, const OptionTable<S>& table, S& settings,
                  const std::optional<std::string>& chosen) {
    const Value* value = root_.find(what);
    const Value* base = value;
    if (value != nullptr && value->kind == Value::Kind::map) base = value->find("base");
    const auto content = fmt::format("the name of a {}, a file, or a map of its settings", what);
    if (base != nullptr) to_text(*base, content);
    if (base != nullptr && !chosen)
      read_base(what, referenced(what, base->text, file_.parent_path(), base->place.to_string()),
                table, settings);
    const auto read_chosen = [&] {
      const auto option = "--" + what;
      read_base(what, referenced(what, *chosen, "", option), table, settings);
    };
    if (base != nullptr && chosen) read_chosen();
    if (value != nullptr && value->kind == Value::Kind::map) {
      Section(what).add(table, settings).read(*value, places_, {"base", "name"});
      if (const Value* name = value->find("name"); name != nullptr && !(base && chosen))
        settings.name = to_text(*name, "a name");
    }
    // A map without a base states every setting; what the chosen file states then wins over it.
    if (base == nullptr && chosen) read_chosen();
  }

  void read_vehicle() {
    read_based("vehicle", vehicle::parameter_options(), scenario_.vehicle, std::nullopt);
  }
  void read_planner() {
    read_based("planner", planner::setting_options(), scenario_.planner, request_.planner);
  }

  const Value& required(const std::string& key) {
    require_key(root_, "a scenario", key);
    const Value& map = *root_.find(key);
    require_map(map, fmt::format("the map of {}", key));
    require_key(map, key, "x");
    require_key(map, key, "y");
    places_[key] = map.place;
    return map;
  }

  void read_start_goal_region() {
    Start start(scenario_.start);
    start_section(start).read(required("start"), places_);
    scenario_.start = start.state();
    goal_section(scenario_.goal).read(required("goal"), places_);
    if (const Value* region = root_.find("region")) {
      region_section(scenario_.region).read(*region, places_);
      places_["region"] = region->place;
    }
  }

  /// Reads a section of options alone, if it is there.
  template <class S>
  void read_plain(const std::string& name, const OptionTable<S>& table, S& settings) {
    if (const Value* value = root_.find(name))
      Section(name).add(table, settings).read(*value, places_);
  }

  void read_obstacles(const Value& list) {
    if (list.kind == Value::Kind::null) return;
    if (list.kind != Value::Kind::sequence)
      throw InvalidValue(list.place.to_string(), list.describe(), "a list of obstacles");
    for (const auto& item : list.items) read_obstacle(item);
  }

  void read_obstacle(const Value& map) {
    require_map(map, "an obstacle (a map with x, y, r, ...)");
    ObstacleEntry entry;
    auto& obstacle = entry.obstacle;
    obstacle.name = fmt::format("O{}", scenario_.obstacles.size() + 1);
    Section section = obstacle_section(obstacle, "an obstacle");
    section.add(repeat_options(), entry);
    Places local;
    section.read(map, local);
    require_key(map, "an obstacle", "x");
    require_key(map, "an obstacle", "y");
    if (map.find("r") == nullptr && (map.find("a") == nullptr || map.find("b") == nullptr))
      throw InvalidValue(map.place.to_string(), "an obstacle without size", "r, or a and b");
    if (map.find("step") != nullptr && map.find("repeat") == nullptr)
      throw InvalidValue(map.place.to_string(), "an obstacle with step alone", "repeat beside it");
    for (int k = 0; k < entry.repeat; ++k) {
      world::Obstacle one = obstacle;
      one.x += k * entry.step[0];
      one.y += k * entry.step[1];
      if (map.find("repeat") != nullptr) one.name += std::to_string(k + 1);
      add_obstacle(one, map.place);
    }
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
      Section("loop")
          .add(sim::loop_options(), scenario_.loop)
          .set("tex", value, value.place, places_);
    }
    for (const auto& assignment : request_.overrides)
      apply_override(assignment, scenario_, places_);
  }

  const ScenarioRequest& request_;
  fs::path file_;
  Value root_;
  sim::Scenario scenario_;
  Places places_;
  std::set<std::string> names_;
};

}  // namespace

sim::Scenario load_scenario(const ScenarioRequest& request) {
  const auto file = find_config("scenario", request.name_or_file, "", "SCENARIO");
  return Loader(request, file, parse_file(file, "a scenario")).load();
}

sim::Scenario parse_scenario(const std::string& text, const std::string& source) {
  return parse_scenario(text, {source, std::nullopt, std::nullopt, {}});
}

sim::Scenario parse_scenario(const std::string& text, const ScenarioRequest& request) {
  const auto& source = request.name_or_file;
  return Loader(request, source, parse_text(text, source, "a scenario")).load();
}

}  // namespace slalom::io
