#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "exit_code.hpp"

namespace slalom::app {
namespace {

int check(const CommonOptions& options) {
  std::vector<std::string> advice;
  const auto scenario = io::load_scenario(options.request, advice);
  if (options.quiet) return kOk;
  if (options.json) {
    nlohmann::ordered_json json;
    json["valid"] = true;
    json["scenario"] = scenario.name;
    json["planner"] = scenario.planner.name;
    json["vehicle"] = scenario.vehicle.name;
    json["obstacles"] = scenario.obstacles.size();
    json["advice"] = advice;
    json["resolved"] = io::to_yaml(scenario);
    print(text_of(json));
  } else {
    print(io::to_yaml(scenario));
    for (const auto& sentence : advice) fmt::print(stderr, "slalom: note: {}\n", sentence);
  }
  return kOk;
}

}  // namespace

void add_check(CLI::App& app, Command& run) {
  auto options = std::make_shared<CommonOptions>();
  auto* command =
      app.add_subcommand("check", "Check a scenario without driving it and print it resolved");
  add_scenario(*command, *options);
  add_overrides(*command, *options, true);
  add_printing(*command, *options);
  command->footer(std::string("Example: slalom check my.yaml --set planner.N=15\n\n") +
                  kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return check(*options); }; });
}

}  // namespace slalom::app
