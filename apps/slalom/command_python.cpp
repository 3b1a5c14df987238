#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "commands.hpp"
#include "exit_code.hpp"

namespace slalom::app {
namespace {

/// Runs a command of the Python package with the words that follow.
constexpr const char* kScript = R"(import sys
try:
    from slalom.{module}.__main__ import main
except ImportError as error:
    print(f"slalom: '{command}' is done by the Python package, which {{sys.executable}} does not have "
          f"({{error}}): install its wheel, or name another Python in SLALOM_PYTHON", file=sys.stderr)
    sys.exit({bad_input})
sys.exit(main(sys.argv[1:], "{command}"))
)";

/// The words that say again what `command` was told.
std::vector<std::string> told(const CLI::App& command) {
  std::vector<std::string> words;
  for (const auto* option : command.get_options()) {
    if (option->count() == 0) continue;
    if (!option->get_positional()) words.push_back("--" + option->get_lnames()[0]);
    if (option->get_expected_max() > 0)
      words.insert(words.end(), option->results().begin(), option->results().end());
  }
  return words;
}

/// Python takes this process's place; returns only where there is none.
int by_python(const CLI::App& command, const char* module) {
  const char* chosen = std::getenv("SLALOM_PYTHON");
  std::vector<std::string> words = {
      chosen != nullptr && *chosen != 0 ? chosen : "python3", "-c",
      fmt::format(kScript, fmt::arg("module", module),
                  fmt::arg("command", "slalom " + command.get_name()),
                  fmt::arg("bad_input", static_cast<int>(kBadInput)))};
  for (auto& word : told(command)) words.push_back(std::move(word));
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  throw InvalidValue(fmt::format("slalom {}", command.get_name()),
                     fmt::format("no Python '{}' ({})", words[0], std::strerror(errno)),
                     "python3, or the one that SLALOM_PYTHON names, with the package slalom");
}

/// What both commands have.
CLI::App* add(CLI::App& app, Command& run, const char* name, const char* description,
              const char* module) {
  auto* command = app.add_subcommand(name, description);
  command->add_flag("--force")->description("Replace a file that stands there already");
  command->add_flag("--quiet")->description("Print nothing but errors");
  command->add_option("--problem", "Of commonroad: the planning problem's id; by default the first")
      ->type_name("ID");
  command->callback(
      [command, module, &run] { run = [command, module] { return by_python(*command, module); }; });
  return command;
}

}  // namespace

void add_import(CLI::App& app, Command& run) {
  auto* command =
      add(app, run, "import", "Make a scenario file from a file of another format", "importing");
  command
      ->add_option("FORMAT",
                   "commonroad (XML of version 2018b or 2020a) or track (CSV of a race track)")
      ->required();
  command->add_option("FILE", "The file to read")->required();
  command
      ->add_option("--out",
                   "The scenario file; by default in the current folder, with the name of FILE")
      ->type_name("FILE");
  command->add_option("--vehicle", "Built-in vehicle or a file; by default bmw_320i")
      ->type_name("NAME");
  command
      ->add_option(
          "--oncoming",
          "Of commonroad: whether adjacent lanes of oncoming traffic are part of the road: "
          "never, always, or needed (the default), only where something stands in the way")
      ->type_name("WHEN");
  command->add_option("--speed", "Of track: speed at the start [m/s]; by default 15")
      ->type_name("U");
  command
      ->add_option("--time", "Of track: drive as far as possible in this time [s]; by default 60")
      ->type_name("S");
  command->add_option("--laps", "Of track: number of laps to drive instead")->type_name("N");
  command->footer(
      std::string("Done by the Python package of python3, or of $SLALOM_PYTHON if it is set.\n"
                  "Example: slalom import commonroad DEU_Test-1_1_T-1.xml --out test.yaml\n\n") +
      kExitCodeHelp);
}

void add_export(CLI::App& app, Command& run) {
  auto* command = add(app, run, "export", "Write a drive in another format", "exporting");
  command
      ->add_option("FORMAT",
                   "mcap (for Foxglove), rerun, or commonroad (a solution for its checkers)")
      ->required();
  command->add_option("FOLDER", "Results of 'slalom simulate'")->required();
  command->add_option("--out", "By default drive.mcap, drive.rrd or solution.xml in the folder")
      ->type_name("FILE");
  command
      ->add_option("--scenario",
                   "Of commonroad: the XML that the drive's scenario was imported from")
      ->type_name("XML");
  command
      ->add_option("--cost", "Of commonroad: the cost function it is entered for; by default JB1")
      ->type_name("NAME");
  command->footer(
      std::string("Done by the Python package of python3, or of $SLALOM_PYTHON if it is set.\n"
                  "Example: slalom export mcap drives/E_C\n\n") +
      kExitCodeHelp);
}

}  // namespace slalom::app
