#include "scenario_sections.hpp"

#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace {

using sim::Scenario;
using Form = ScenarioSection::Form;

/// What files say of an obstacle beside its own options.
const OptionTable<ObstacleEntry>& entry_options() {
  static const auto table = [] {
    using E = ObstacleEntry;
    const auto any = OptionRange::any();
    OptionTable<ObstacleEntry> t;
    t.real("length", &E::length, OptionRange::positive(), "m",
           "Of a box, along its own x axis and about its centre.")
        .real("width", &E::width, OptionRange::positive(), "m", "Of a box, across.")
        .real("speed", &E::speed, OptionRange::non_negative(), "m/s",
              "Along a path, from its first point at t = 0.")
        .real("acceleration", &E::acceleration, any, "m/s^2",
              "Along a path, until the obstacle stands or has come to the end.")
        .choice(
            "before", &E::before, world::beyond_end_names(),
            "Before the first row of a table: it stands there, goes on as it moves there, or is "
            "absent.")
        .choice("after", &E::after, world::beyond_end_names(),
                "After the last row of a table: likewise.")
        .integer("repeat", &ObstacleEntry::repeat, OptionRange::closed(1, 1000), "1",
                 "How many of these stand in a row; they are named name1, name2, ...")
        .vector("step", &ObstacleEntry::step, OptionRange::any(), "m",
                "From the centre of one to the centre of the next, [east, north].");
    return t;
  }();
  return table;
}

template <class S>
Section section(const char* name, const OptionTable<S>& table, S& settings) {
  return Section(name).add(table, settings);
}

}  // namespace

const std::vector<ScenarioSection>& scenario_sections() {
  static const std::vector<ScenarioSection> sections = {
      {.name = "start",
       .form = Form::flow,
       .required = {"x", "y"},
       .about = "The vehicle's state at t = 0.",
       .bind =
           [](Scenario& s) {
             return section("start", vehicle::state_options(), s.start)
                 .add_degrees("psi")
                 .add_degrees("sa");
           }},
      {.name = "goal",
       .form = Form::flow,
       .required = {"x", "y"},
       .instead = {"s", "time", "laps"},
       .beside = {"psi", "psi_deg", "sigma"},
       .about =
           "Where the drive is to end: a square, a rectangle, or what the road has: a line across "
           "it, as far as possible in a time. What else is asked on arrival may be left out.",
       .bind =
           [](Scenario& s) {
             return section("goal", world::goal_options(), s.goal)
                 .add_degrees("psi")
                 .add_degrees("psi_tolerance");
           }},
      {.name = "region",
       .form = Form::flow,
       .about = "A box in which the vehicle's footprint lies at every node of a plan.",
       .bind = [](Scenario& s) { return section("region", world::region_options(), s.region); }},
      {.name = "road",
       .form = Form::road,
       .about =
           "A corridor to stay in, about a reference line: `points`, a list of [x, y, width to "
           "the right, width to the left] in m, or `file`, a CSV file beside the scenario with "
           "the columns x_m, y_m, w_tr_right_m and w_tr_left_m; `closed`, whether the last point "
           "joins the first (`false`); and `lanes`, lines that are drawn, each a list of "
           "[x, y]."},
      {.name = "obstacles",
       .form = Form::list,
       .about =
           "A list. Each obstacle has one place: `x` and `y`, a `table`, or a `path`; and one "
           "size: "
           "`r`, `a` and `b`, `length` and `width`, or a `polygon`. [obstacles.md](obstacles.md) "
           "shows each."},
      {.name = "loop",
       .about = "The closed loop.",
       .bind = [](Scenario& s) { return section("loop", sim::loop_options(), s.loop); }},
      {.name = "plant",
       .about = "How the plant differs from the `vehicle` that planner and prediction believe in; "
                "see [formulation.md](formulation.md), section 4. The defaults change nothing.",
       .bind = [](Scenario& s) { return section("plant", sim::plant_options(), s.plant); }},
      {.name = "sensing",
       .about = "How what the planner is told differs from what is. The defaults tell the truth.",
       .bind = [](Scenario& s) { return section("sensing", sim::sensing_options(), s.sensing); }},
      {.name = "planner",
       .in_files = true,
       .about = "The trajectory-planning problem and its solver.",
       .bind =
           [](Scenario& s) { return section("planner", planner::setting_options(), s.planner); }},
      {.name = "vehicle",
       .in_files = true,
       .about = "The vehicle; the defaults are the HMMWV's.",
       .bind =
           [](Scenario& s) { return section("vehicle", vehicle::parameter_options(), s.vehicle); }},
  };
  return sections;
}

const ScenarioSection* find_section(const std::string& name) {
  for (const auto& section : scenario_sections())
    if (section.name == name && section.bind != nullptr) return &section;
  return nullptr;
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const auto& section : scenario_sections()) names.push_back(section.name);
  return names;
}

std::vector<std::string> scenario_keys() {
  auto keys = section_names();
  keys.insert(keys.begin(), {"name", "title"});
  return keys;
}

Section obstacle_section(world::Obstacle& obstacle, const std::string& path) {
  Section section(path);
  section.add(world::obstacle_options(), obstacle);
  OptionInfo radius;
  radius.name = "r";
  radius.kind = OptionKind::real;
  radius.range = OptionRange::positive();
  radius.unit = "m";
  radius.doc = "Radius of a circle, instead of a and b.";
  section.add(
      {radius,
       [&obstacle](const OptionValue& value) { obstacle.a = obstacle.b = std::get<double>(value); },
       [&obstacle] { return OptionValue(obstacle.a); },
       {"a", "b"}});
  return section.add_degrees("psi");
}

Section entry_section(ObstacleEntry& entry) {
  return obstacle_section(entry.obstacle, "an obstacle").add(entry_options(), entry);
}

std::vector<std::pair<std::string, OptionValue>> values_of(const sim::Scenario& scenario) {
  auto copy = scenario;  // sections are bound to what they could also set
  std::vector<std::pair<std::string, OptionValue>> values;
  const auto add = [&](const Section& section) {
    for (const auto& field : section.fields())
      if (field.excludes.empty())
        values.emplace_back(section.path() + "." + field.info.name, field.load());
  };
  for (const auto& section : scenario_sections())
    if (section.bind != nullptr) add(section.bind(copy));
  for (auto& obstacle : copy.obstacles)
    add(obstacle_section(obstacle, "obstacles." + obstacle.name));
  return values;
}

}  // namespace slalom::io
