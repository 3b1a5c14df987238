#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "../../src/io/file_set.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/results_folder.hpp"
#include "slalom/planner/lap.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::app {
namespace {

const std::vector<std::string> kOutcomes = {"solved", "not_solved", "interrupted"};

struct LapOptions {
  CommonOptions common;
  double interval = planner::LapSettings{}.interval;
  double margin = planner::LapSettings{}.margin;
  int max_meshes = planner::LapSettings{}.max_meshes;
};

std::string csv(const planner::Lap& lap) {
  std::string text = "s_m,t_s";
  for (const char* name : vehicle::kStateNames) text += fmt::format(",{}", name);
  text += ",sr,jx\n";
  for (std::size_t k = 0; k < lap.s.size(); ++k) {
    text += fmt::format("{},{}", lap.s[k], lap.t[k]);
    for (const double value : lap.states[k]) text += fmt::format(",{}", value);
    for (const double value : lap.controls[k]) text += fmt::format(",{}", value);
    text += "\n";
  }
  return text;
}

std::string json(const sim::Scenario& scenario, const planner::Lap& lap) {
  const auto& refined = lap.refined;
  nlohmann::ordered_json out = {{"scenario", scenario.name},
                                {"vehicle", scenario.vehicle.name},
                                {"length_m", scenario.road->length()},
                                {"status", to_string(refined.status)},
                                {"time_s", lap.time},
                                {"largest_error", refined.errors.largest}};
  for (const auto& mesh : refined.meshes)
    out["meshes"].push_back({{"intervals", mesh.intervals},
                             {"iterations", mesh.iterations},
                             {"objective", mesh.objective},
                             {"solve_s", mesh.wall_s}});
  return text_of(out);
}

void write(const std::filesystem::path& folder, const planner::Lap& lap) {
  io::FileSet files;
  files.add(folder / "lap.csv", csv(lap));
  files.replace_results(folder);
  files.commit();
}

int lap(const LapOptions& options) {
  poll_interrupts();
  check_expectations(options.common.expect, kOutcomes);
  const auto scenario = io::load_scenario(options.common.request);
  if (!scenario.road)
    throw InvalidValue(scenario.name, "a scenario without a road",
                       "a section `road` that is closed", {"road"});
  planner::LapSettings settings;
  if (options.interval < planner::least_lap_interval(*scenario.road))
    throw InvalidValue(
        "--interval", fmt::format("{}", options.interval),
        fmt::format("at least {:.3g} m for a road of {:.0f} m",
                    planner::least_lap_interval(*scenario.road), scenario.road->length()));
  settings.interval = options.interval;
  settings.margin = options.margin;
  settings.max_meshes = options.max_meshes;
  settings.interrupted = interrupted;
  io::ResultsFolder folder;
  if (options.common.writes())
    write_or_fail([&] { folder = {options.common.out, options.common.force}; });
  const auto lap = planner::fastest_lap(*scenario.road, scenario.vehicle, settings);
  const bool solved = !lap.s.empty();
  // An interrupt that comes when the last mesh is solved loses nothing.
  if (interrupted() && lap.refined.status == ocp::RefineStatus::not_solved)
    return exit_code_for("interrupted", options.common.expect);
  if (options.common.writes() && solved) write_or_fail([&] { write(options.common.out, lap); });
  if (options.common.json) {
    print(json(scenario, lap));
  } else if (!options.common.quiet) {
    const auto& refined = lap.refined;
    print(solved
              ? fmt::format("{} with {}: {:.3f} s for {:.1f} m, {:.1f} m/s on average\n{}",
                            scenario.name, scenario.vehicle.name, lap.time, scenario.road->length(),
                            scenario.road->length() / lap.time, refined.table())
              : fmt::format("{} with {}: no lap was found\n{}", scenario.name,
                            scenario.vehicle.name, refined.table()));
  }
  return exit_code_for(solved ? "solved" : "not_solved", options.common.expect);
}

}  // namespace

void add_lap(CLI::App& app, Command& run) {
  auto options = std::make_shared<LapOptions>();
  auto* command = app.add_subcommand("lap", "Find the fastest flying lap of a scenario's road");
  add_scenario(*command, options->common);
  add_overrides(*command, options->common, true);
  command
      ->add_option("--interval", options->interval,
                   "Length of the first mesh's intervals along the road [m]")
      ->check(no_nan())
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--margin", options->margin, "Margin to the road's edges [m]")
      ->check(no_nan())
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--meshes", options->max_meshes,
                   "Greatest number of meshes, solved one after another")
      ->check(CLI::Range(1, 15))
      ->capture_default_str();
  add_output(*command, options->common);
  add_printing(*command, options->common);
  add_expect(*command, options->common, "solved, not_solved, interrupted");
  command->footer(
      std::string("The vehicle's own model along the road, offline, without obstacles. Columns of\n"
                  "lap.csv in the folder that --out names are SI units and radians.\n"
                  "Example: slalom lap circuit --vehicle bmw_320i --out laps/bmw\n\n") +
      kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return lap(*options); }; });
}

}  // namespace slalom::app
