#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "obstacle_reader.hpp"
#include "road_reader.hpp"
#include "scenario_sections.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace {

/// `text` in double quotes; a JSON string is a YAML string.
std::string yaml_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string yaml_value(const OptionInfo& info, const OptionValue& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    return info.kind == OptionKind::choice ? *text : yaml_text(*text);
  if (const auto* number = std::get_if<double>(&value)) return yaml_number(*number);
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    std::vector<std::string> texts;
    for (double number : *numbers) texts.push_back(yaml_number(number));
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  return to_string(value);
}

/// "  key: value" for every key that is not to be left out.
std::string block(const Section& section, const std::set<std::string>& without) {
  std::string text;
  for (const auto& field : section.fields())
    if (without.count(field.info.name) == 0)
      text += fmt::format("  {}: {}\n", field.info.name, yaml_value(field.info, field.load()));
  return text;
}

/// "{key: value, ...}" for every key that is not infinite (an absent side), not another way to
/// write one of the others, and not to be left out.
std::string flow(const Section& section, const std::set<std::string>& without) {
  std::string text;
  for (const auto& field : section.fields()) {
    const auto value = field.load();
    if (const auto* number = std::get_if<double>(&value); number && std::isinf(*number)) continue;
    if (!field.excludes.empty() || without.count(field.info.name) > 0) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", field.info.name,
                        yaml_value(field.info, value));
  }
  return "{" + text + "}";
}

/// What other keys say of an obstacle, and what has its default in a plain one.
std::set<std::string> left_out(const world::Obstacle& o) {
  std::set<std::string> names;
  if (o.outline) names.insert({"a", "b"});
  if (o.trajectory) names.insert({"x", "y", "vx", "vy", "psi"});
  if (o.is_plain() && o.psi == 0) names.insert("psi");
  if (o.margin_start == 0) names.insert("margin_start");
  if (o.margin_rate == 0) names.insert("margin_rate");
  return names;
}

/// Where a goal of the road lies follows from the road; `as_stated` leaves out what else follows.
std::set<std::string> left_out(const ScenarioSection& section, const sim::Scenario& scenario,
                               bool as_stated) {
  if (section.name == "loop" && as_stated && scenario.sm_crash_follows) return {"sm_crash"};
  if (section.name != "goal") return {};
  if (!scenario.goal.is_place()) return {"x", "y", "psi", "sigma"};
  return scenario.goal.kind() == world::GoalKind::rectangle ? std::set<std::string>{"sigma"}
                                                            : std::set<std::string>{};
}

std::string list(std::vector<world::Obstacle>& obstacles) {
  std::string text = obstacles.empty() ? " []\n" : "\n";
  for (auto& obstacle : obstacles) {
    auto line = flow(obstacle_section(obstacle, "obstacles"), left_out(obstacle));
    line.insert(line.size() - 1, obstacle_extras(obstacle));
    text += fmt::format("  - {}\n", line);
  }
  return text;
}

/// What stands behind "section:".
std::string content(const ScenarioSection& section, sim::Scenario& scenario, bool as_stated) {
  const auto without = left_out(section, scenario, as_stated);
  switch (section.form) {
    case ScenarioSection::Form::flow:
      return " " + flow(section.bind(scenario), without) + "\n";
    case ScenarioSection::Form::block:
      return "\n" + block(section.bind(scenario), without);
    case ScenarioSection::Form::list:
      return list(scenario.obstacles);
    case ScenarioSection::Form::road:
      return road_text(*scenario.road);
  }
  return "\n";
}

std::string whole_text(const sim::Scenario& scenario, bool as_stated) {
  std::string text = "# Everything resolved: this file alone gives the drive. SI units, radians.\n";
  text += fmt::format("name: {}\ntitle: {}\n", yaml_text(scenario.name), yaml_text(scenario.title));
  auto copy = scenario;  // sections are bound to what they could also set
  for (const auto& section : scenario_sections()) {
    if (section.form == ScenarioSection::Form::road && !scenario.road) continue;
    text += fmt::format("{}:{}", section.name, content(section, copy, as_stated));
  }
  return text;
}

}  // namespace

/// With an exponent it gets a point too, for many readers take 1e-09 for text.
std::string yaml_number(double number) {
  auto text = fmt::format("{}", number);
  const auto exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos)
    text.insert(exponent, ".0");
  return text;
}

std::string yaml_rows(const std::vector<std::vector<double>>& rows, const std::string& between) {
  std::vector<std::string> lists;
  for (const auto& row : rows) {
    std::vector<std::string> numbers;
    for (const double number : row) numbers.push_back(yaml_number(number));
    lists.push_back(fmt::format("[{}]", fmt::join(numbers, ", ")));
  }
  return fmt::format("[{}]", fmt::join(lists, between));
}

std::string to_yaml(const sim::Scenario& scenario) {
  return whole_text(scenario, false);
}

std::string to_yaml_as_stated(const sim::Scenario& scenario) {
  return whole_text(scenario, true);
}

}  // namespace slalom::io
