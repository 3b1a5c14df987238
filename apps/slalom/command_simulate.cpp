#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "commands.hpp"
#include "drive_text.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/sim/closed_loop.hpp"

namespace slalom::app {
namespace {

int simulate(const CommonOptions& options) {
  check_expectations(options.expect, sim::outcome_names());
  const auto scenario = io::load_scenario(options.request);
  if (options.writes()) write_or_fail([&] { io::prepare_folder(options.out, options.force); });

  sim::Drive drive;
  {
    Progress progress(scenario.name + " " + scenario.planner.name, options.quiet);
    sim::LoopHooks hooks;
    hooks.on_cycle = [&](const sim::Cycle& cycle) { progress.show(cycle); };
    hooks.interrupted = interrupted;
    drive = sim::drive(scenario, hooks);
  }

  if (options.writes()) write_or_fail([&] { io::write_drive(options.out, scenario, drive); });
  if (options.json) {
    print(io::summary_json(scenario, drive));
  } else if (!options.quiet) {
    auto text = drive_text(scenario, drive);
    if (options.writes()) text += fmt::format("  written to         {}\n", options.out);
    print(text);
  }
  return exit_code_for(sim::to_string(drive.outcome), options.expect);
}

}  // namespace

void add_simulate(CLI::App& app, Command& run) {
  auto options = std::make_shared<CommonOptions>();
  auto* command = app.add_subcommand("simulate", "Drive a scenario in closed loop");
  add_scenario(*command, *options);
  add_overrides(*command, *options, true);
  add_output(*command, *options);
  add_printing(*command, *options);
  add_expect(*command, *options, fmt::format("{}", fmt::join(sim::outcome_names(), ", ")));
  command->footer(std::string("Example: slalom simulate E_C --planner P_D --out drives/E_C\n"
                              "It leaves report.html there, on which the drive plays.\n\n") +
                  kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return simulate(*options); }; });
}

}  // namespace slalom::app
