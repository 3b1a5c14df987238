#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "../../src/paper/published_sweep.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "slalom/sweep/sweep_pages.hpp"
#include "slalom/sweep/trial_drive.hpp"
#include "sweep_server.hpp"
#include "worker_command.hpp"

namespace slalom::app {
namespace {

constexpr int kPort = 8710;

struct ReportOptions {
  std::string folder;
  std::vector<std::int64_t> trials;
  int port = -1;
};

int study_report(const ReportOptions& options) {
  poll_interrupts();
  for (const auto trial : options.trials) {
    if (interrupted()) return kInterrupted;
    sweep::TrialDrive drive;
    write_or_fail(
        [&] { drive = sweep::trial_drive(options.folder, trial, worker_command(), interrupted); });
    if (drive.interrupted) return kInterrupted;
    print(fmt::format(
        "trial {}: {} ({}, {})\n", trial, (drive.folder / "report.html").string(),
        drive.again ? "driven again" : "kept",
        drive.difference.empty() ? "as recorded" : "NOT as recorded: " + drive.difference));
  }
  write_or_fail([&] { sweep::write_sweep_report(options.folder, paper::published_sweep()); });
  print(fmt::format("written to {}/index.html\n", options.folder));
  if (options.port >= 0) write_or_fail([&] { serve_sweep(options.folder, options.port); });
  return kOk;
}

}  // namespace

void add_study_report(CLI::App& app, Command& run) {
  auto options = std::make_shared<ReportOptions>();
  auto* command = app.add_subcommand("study-report", "Make the page of a sweep from its results");
  command->add_option("DIR", options->folder, "Folder of a sweep")->required();
  command
      ->add_option("--trial", options->trials,
                   "Drive these trials again into DIR/drives/, where they were not kept: to the "
                   "same bits, unless they go by the clock")
      ->type_name("N[,...]")
      ->delimiter(',');
  command
      ->add_option("--serve", options->port,
                   fmt::format("Show the page at this port of this machine ({}), and drive a trial "
                               "again when it is clicked on",
                               kPort))
      ->type_name("[PORT]")
      ->expected(0, 1)
      ->default_str(fmt::format("{}", kPort))
      ->check(CLI::Range(0, 65535));
  command->footer(std::string("Leaves DIR/index.html and DIR/figures/. They take the place of "
                              "earlier ones.\n"
                              "Example: slalom study-report sweeps/paper --serve\n\n") +
                  kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return study_report(*options); }; });
}

}  // namespace slalom::app
