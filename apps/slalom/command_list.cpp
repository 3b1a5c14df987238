#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "exit_code.hpp"

namespace slalom::app {
namespace {

int list(const CommonOptions& options) {
  const std::pair<const char*, std::vector<io::BuiltIn>> kinds[] = {
      {"scenarios", io::built_in_scenarios()},
      {"planners", io::built_in_planners()},
      {"vehicles", io::built_in_vehicles()},
      {"studies", io::built_in_studies()}};
  nlohmann::ordered_json json;
  std::string text;
  for (const auto& [kind, entries] : kinds) {
    json[kind] = nlohmann::ordered_json::array();
    text += fmt::format("{}:\n", kind);
    for (const auto& entry : entries) {
      json[kind].push_back({{"name", entry.name}, {"title", entry.title}, {"path", entry.path}});
      text += fmt::format("  {:<14} {}\n", entry.name, entry.title);
    }
  }
  print(options.json ? text_of(json) : text);
  return kOk;
}

}  // namespace

void add_list(CLI::App& app, Command& run) {
  auto options = std::make_shared<CommonOptions>();
  auto* command =
      app.add_subcommand("list", "List the built-in scenarios, planners, vehicles and studies");
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->callback([options, &run] { run = [options] { return list(*options); }; });
}

}  // namespace slalom::app
