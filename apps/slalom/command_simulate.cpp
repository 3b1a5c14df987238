#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <limits>
#include <memory>

#include "commands.hpp"
#include "drive_text.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/recording_file.hpp"
#include "slalom/io/results_folder.hpp"
#include "slalom/sim/advice.hpp"
#include "slalom/sim/closed_loop.hpp"

namespace slalom::app {
namespace {

struct SimulateOptions : CommonOptions {
  std::string record;                                     ///< folder for recorded solves
  double slow = std::numeric_limits<double>::infinity();  ///< record from this solve time on [s]
};

/// Writes solves and plans that failed or were slow, each to a file of its own.
class Recordings {
 public:
  Recordings(const SimulateOptions& options, const sim::Scenario& scenario)
      : options_(options), scenario_(scenario), cycle_(scenario.loop.warm_up ? 0 : 1) {
    if (options.record.empty()) return;
    write_or_fail([&] { io::prepare_recordings(options.record, options.force); });
  }

  planner::Recorder recorder() {
    if (options_.record.empty()) return {};
    return {[this](const planner::SolveReport& report) {
              const bool failed =
                  !report.solved && report.status != planner::PlanStatus::interrupted;
              return failed || report.cpu_s >= options_.slow;
            },
            [this](const planner::Recording& recording) {
              write(io::to_json(io::RecordedSolve{scenario_, recording}));
            },
            [this](const planner::RecordedPlan& plan) {
              write(io::to_json(io::RecordedMotion{scenario_, plan}));
            }};
  }
  void next_cycle() {
    ++cycle_;
    of_cycle_ = 0;
  }
  std::string text() const {
    if (options_.record.empty()) return "";
    const bool verifies = scenario_.planner.method == planner::Method::verified;
    return fmt::format("  recorded           {} {} in {}\n", count_, verifies ? "plans" : "solves",
                       options_.record);
  }

 private:
  void write(const std::string& text) {
    // A cycle may solve again and again, on finer meshes or for another way.
    const auto name = ++of_cycle_ == 1 ? fmt::format("cycle-{}.json", cycle_)
                                       : fmt::format("cycle-{}-{}.json", cycle_, of_cycle_);
    write_or_fail([&] { io::write_file(std::filesystem::path(options_.record) / name, text); });
    ++count_;
  }

  const SimulateOptions& options_;
  const sim::Scenario& scenario_;
  int cycle_, of_cycle_ = 0, count_ = 0;
};

int simulate(const SimulateOptions& options) {
  poll_interrupts();
  check_expectations(options.expect, sim::outcome_names());
  const auto scenario = io::load_scenario(options.request);
  io::ResultsFolder folder;
  if (options.writes()) write_or_fail([&] { folder = {options.out, options.force}; });

  Recordings recordings(options, scenario);
  sim::Drive drive;
  if (!options.quiet && !options.json)
    for (const auto& sentence : sim::advice_at_start(scenario))
      fmt::print(stderr, "slalom: note: {}\n", sentence);
  {
    Progress progress(scenario.name + " " + scenario.planner.name, options.quiet);
    sim::LoopHooks hooks;
    hooks.on_cycle = [&](const sim::Cycle& cycle) {
      progress.show(cycle);
      recordings.next_cycle();
    };
    hooks.record = recordings.recorder();
    hooks.interrupted = interrupted;
    drive = sim::drive(scenario, hooks);
  }

  if (options.writes()) write_or_fail([&] { io::write_drive(options.out, scenario, drive); });
  if (options.json) {
    print(io::summary_json(scenario, drive));
  } else if (!options.quiet) {
    auto text = drive_text(scenario, drive);
    if (options.writes())
      text += fmt::format("  written to         {}, its page is {}\n", options.out,
                          (std::filesystem::path(options.out) / "report.html").string());
    print(text + recordings.text());
  }
  return exit_code_for(sim::to_string(drive.outcome), options.expect);
}

}  // namespace

void add_simulate(CLI::App& app, Command& run) {
  auto options = std::make_shared<SimulateOptions>();
  auto* command = app.add_subcommand("simulate", "Drive a scenario in closed loop");
  add_scenario(*command, *options);
  add_overrides(*command, *options, true);
  add_output(*command, *options);
  auto* record = command->add_option("--record-failures", options->record,
                                     "Folder for solves that fail, one file each, which 'slalom "
                                     "replay' solves again");
  record->type_name("DIR");
  command
      ->add_option("--record-slow", options->slow,
                   "Record solves of at least this thread time too [s]")
      ->needs(record)
      ->check(no_nan())
      ->check(CLI::NonNegativeNumber);
  add_printing(*command, *options);
  add_expect(*command, *options, fmt::format("{}", fmt::join(sim::outcome_names(), ", ")));
  command->footer(std::string("Example: slalom simulate E_C --planner P_D --out drives/E_C\n"
                              "It leaves report.html there, on which the drive plays.\n\n") +
                  kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return simulate(*options); }; });
}

}  // namespace slalom::app
