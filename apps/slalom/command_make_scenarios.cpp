#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "slalom/io/scenario_set.hpp"
#include "slalom/sweep/families.hpp"

namespace slalom::app {
namespace {

struct MakeOptions {
  std::string family, out;
  int count = 10;
  std::uint32_t seed = 0;
  double difficulty = 0.5;
  bool force = false, json = false, quiet = false;
};

int make_scenarios(const MakeOptions& options) {
  poll_interrupts();
  std::vector<sim::Scenario> made;
  for (int index = 1; index <= options.count; ++index) {
    if (interrupted()) return kInterrupted;
    made.push_back(sweep::make_scenario(
        options.family, {.seed = options.seed, .index = index, .difficulty = options.difficulty}));
  }
  write_or_fail([&] { io::write_scenarios(options.out, made, options.force); });
  if (options.json) {
    auto names = nlohmann::ordered_json::array();
    for (const auto& scenario : made) names.push_back(options.out + "/" + scenario.name + ".yaml");
    print(text_of({{"family", options.family},
                   {"seed", options.seed},
                   {"difficulty", options.difficulty},
                   {"files", names}}));
  } else if (!options.quiet) {
    print(fmt::format("{} scenarios of {} written to {}\n", made.size(), options.family,
                      options.out));
  }
  return kOk;
}

}  // namespace

void add_make_scenarios(CLI::App& app, Command& run) {
  auto options = std::make_shared<MakeOptions>();
  auto* command = app.add_subcommand("make-scenarios", "Make random scenarios of one family");
  std::string list = "Families:\n";
  for (const auto& family : sweep::families())
    list += fmt::format("  {:<20}{}\n", family.name, family.about);
  command->add_option("FAMILY", options->family, "Which kind; see below")->required();
  command->add_option("--count", options->count, "How many")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "The same seed makes the same scenarios")
      ->capture_default_str();
  command->add_option("--difficulty", options->difficulty, "0 (easy) to 1 (hard)")
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the files FAMILY-0001.yaml, ...")
      ->type_name("DIR")
      ->required()
      ->check([](const std::string& text) {
        return text.empty() ? std::string("found '', expected a folder") : std::string();
      });
  command->add_flag("--force", options->force, "Replace files of the same names");
  auto* json = command->add_flag("--json", options->json, "Print what was written as JSON");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors")->excludes(json);
  command->footer(list +
                  "\nExample: slalom make-scenarios gates --count 20 --seed 1 --out gates\n\n" +
                  kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return make_scenarios(*options); }; });
}

}  // namespace slalom::app
