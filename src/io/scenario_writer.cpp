#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "scenario_tables.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace {

/// `text` in double quotes; a JSON string is a YAML string.
std::string yaml_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The shortest decimal that reads back to the same bits. With an exponent it gets a point too, for
/// many readers take 1e-09 for text.
std::string yaml_number(double number) {
  auto text = fmt::format("{}", number);
  const auto exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos)
    text.insert(exponent, ".0");
  return text;
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

/// "  key: value" for every option of the table but its name.
template <class S>
std::string block(const OptionTable<S>& table, const S& settings) {
  std::string text;
  for (const auto& entry : table.entries()) {
    if (entry.info.name == "name") continue;
    text += fmt::format("  {}: {}\n", entry.info.name, yaml_value(entry.info, entry.get(settings)));
  }
  return text;
}

/// "{key: value, ...}" for every option of the table that is not infinite (an absent side).
template <class S>
std::string flow(const OptionTable<S>& table, const S& settings) {
  std::string text;
  for (const auto& entry : table.entries()) {
    const auto value = entry.get(settings);
    if (const auto* number = std::get_if<double>(&value); number && std::isinf(*number)) continue;
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", entry.info.name,
                        yaml_value(entry.info, value));
  }
  return "{" + text + "}";
}

}  // namespace

std::string to_yaml(const sim::Scenario& scenario) {
  std::string text = "# Everything resolved: this file alone gives the drive. SI units, radians.\n";
  text += fmt::format("name: {}\ntitle: {}\n", yaml_text(scenario.name), yaml_text(scenario.title));
  text += fmt::format("start: {}\n", flow(start_options(), Start(scenario.start)));
  text += fmt::format("goal: {}\n", flow(goal_options(), scenario.goal));
  text += fmt::format("region: {}\n", flow(region_options(), scenario.region));
  text += scenario.obstacles.empty() ? "obstacles: []\n" : "obstacles:\n";
  for (const auto& obstacle : scenario.obstacles)
    text += fmt::format("  - {}\n", flow(obstacle_options(), obstacle));
  text += fmt::format("loop:\n{}", block(sim::loop_options(), scenario.loop));
  text += fmt::format("plant:\n{}", block(sim::plant_options(), scenario.plant));
  text += fmt::format("sensing:\n{}", block(sim::sensing_options(), scenario.sensing));
  text += fmt::format("planner:\n  name: {}\n{}", yaml_text(scenario.planner.name),
                      block(planner::setting_options(), scenario.planner));
  text += fmt::format("vehicle:\n  name: {}\n{}", yaml_text(scenario.vehicle.name),
                      block(vehicle::parameter_options(), scenario.vehicle));
  return text;
}

}  // namespace slalom::io
