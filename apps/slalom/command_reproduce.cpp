#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "../../src/paper/comparison.hpp"
#include "../../src/paper/evaluation.hpp"
#include "../../src/paper/paper_data.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/io/results_folder.hpp"
#include "slalom/sim/closed_loop.hpp"
#include "slalom/sim/solve_times.hpp"
#include "slalom/sweep/sweep.hpp"

namespace slalom::app {
namespace {

namespace fs = std::filesystem;

struct ReproduceOptions : CommonOptions {
  std::vector<std::string> sweeps;
  bool besides = false;
  int repeats = 1;
};

std::string row(const paper::ReproducedDrive& one, const paper::PaperDrive* paper) {
  const auto& drive = one.drive;
  const auto end =
      fmt::format("{} {}", sim::to_string(drive.outcome), drive.hit.empty() ? "" : drive.hit);
  auto text = fmt::format("{:<17} {:<14} {:>7.2f} s {:>9.2f} m", one.folder, end, drive.time,
                          // A crash is located to rounding; "-0.00" would puzzle.
                          std::abs(drive.least_clearance) < 0.005 ? 0.0 : drive.least_clearance);
  if (paper != nullptr) text += fmt::format("   | {} {:.1f} s", paper->outcome, paper->time);
  return text + "\n";
}

std::string table_head() {
  return fmt::format("{:<17} {:<14} {:>9} {:>11}   | {}\n", "drive", "outcome", "time", "clearance",
                     "paper");
}

/// Drives, writes and prints one after the other.
class Driver {
 public:
  Driver(const ReproduceOptions& options, std::size_t count)
      : options_(options), text_(!options.quiet && !options.json), count_(count) {
    if (text_) print(table_head());
  }

  /// False when interrupted.
  bool drive(paper::ReproducedDrive& one, const paper::PaperDrive* printed, bool kept = true) {
    Progress progress(fmt::format("{}/{} {}", ++index_, count_, one.folder), options_.quiet);
    sim::LoopHooks hooks;
    hooks.on_cycle = [&](const sim::Cycle& cycle) { progress.show(cycle); };
    hooks.interrupted = interrupted;
    one.drive = sim::drive(one.scenario, hooks);
    if (options_.repeats > 1 && one.drive.outcome != sim::Outcome::interrupted) repeat(one, hooks);
    const bool whole = one.drive.outcome != sim::Outcome::interrupted && !interrupted();
    if (!kept) return whole;
    if (options_.writes())
      write_or_fail(
          [&] { io::write_drive(fs::path(options_.out) / one.folder, one.scenario, one.drive); });
    as_paper_ &= printed == nullptr || paper::as_paper(one.drive, *printed);
    if (text_) print(row(one, printed));
    json_.push_back(nlohmann::ordered_json::parse(io::summary_json(one.scenario, one.drive)));
    return whole;
  }

  bool text() const { return text_; }
  bool as_paper() const { return as_paper_; }
  const nlohmann::ordered_json& json() const { return json_; }

 private:
  /// Drives again, for its solve times.
  void repeat(paper::ReproducedDrive& one, const sim::LoopHooks& hooks) {
    std::vector<std::vector<double>> runs = {sim::solve_times(one.drive, true)};
    for (int i = 1; i < options_.repeats; ++i) {
      const auto again = sim::drive(one.scenario, hooks);
      if (again.outcome == sim::Outcome::interrupted) break;
      runs.push_back(sim::solve_times(again, true));
    }
    one.cpu = sim::cycle_medians(runs);
  }

  const ReproduceOptions& options_;
  bool text_, as_paper_ = true;
  std::size_t count_, index_ = 0;
  nlohmann::ordered_json json_ = nlohmann::ordered_json::array();
};

/// All scenarios, before the first is driven: a mistake in --set shows at once. So does a folder
/// without a sweep.
paper::Reproduction load(const ReproduceOptions& options) {
  paper::Reproduction all;
  all.paper = paper::load_paper_data();
  all.drives = paper::load_drives(all.paper, options.request);
  all.cases = paper::load_concept_cases(options.request);
  if (options.besides) all.besides = paper::load_besides(options.request);
  for (const auto& folder : options.sweeps)
    all.sweeps.push_back({folder, sweep::read_sweep(folder)});
  all.repeats = options.repeats;
  return all;
}

/// False when interrupted.
bool drive_all(paper::Reproduction& all, Driver& driver) {
  for (auto& one : all.drives)
    if (!driver.drive(one, paper::find(all.paper, one))) return false;
  for (auto& one : all.cases)
    if (!driver.drive(one.driven, nullptr)) return false;
  for (auto& one : all.besides)
    if (!driver.drive(one, nullptr, false)) return false;
  return true;
}

int reproduce(const ReproduceOptions& options) {
  poll_interrupts();
  check_expectations(options.expect, {"paper"});
  auto all = load(options);
  const fs::path out = options.out;
  io::ResultsFolder folder;
  if (options.writes())
    write_or_fail([&] {
      folder = {out, options.force};
      for (const auto& one : all.drives) io::prepare_folder(out / one.folder, options.force);
      for (const auto& one : all.cases) io::prepare_folder(out / one.driven.folder, options.force);
    });

  Driver driver(options, all.drives.size() + all.cases.size() + all.besides.size());
  if (!drive_all(all, driver)) {
    if (driver.text()) print("interrupted: the page of all drives is not written\n");
    return kInterrupted;
  }
  if (options.writes()) {
    write_or_fail([&] { paper::write_reproduction(out, all); });
    if (driver.text()) print(fmt::format("written to {}\n", (out / "index.html").string()));
  }
  if (options.json) print(text_of(driver.json()));
  return options.expect.empty() || driver.as_paper() ? kOk : kNotExpected;
}

}  // namespace

void add_reproduce(CLI::App& app, Command& run) {
  auto options = std::make_shared<ReproduceOptions>();
  auto* command =
      app.add_subcommand("reproduce", "Drive what the paper's figures and text show, and compare");
  add_overrides(*command, *options, false);
  add_output(*command, *options);
  add_printing(*command, *options);
  command
      ->add_option("--expect", options->expect,
                   "'paper': exit with 1 unless every drive ends as the paper's")
      ->type_name("paper");
  command
      ->add_option(
          "--sweep", options->sweeps,
          "Also judge the paper's claims about its sweep by this sweep of E_C; may be given "
          "several times")
      ->type_name("DIR");
  command->add_flag("--besides", options->besides,
                    "Also run the drives that are used only to judge claims; they are not written");
  command
      ->add_option("--repeats", options->repeats,
                   "Run each drive N times, and judge solve times by each cycle's median")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command->footer(std::string("Leaves DIR/SCENARIO/PLANNER/ and DIR/cases/LETTER/ for each drive,\n"
                              "DIR/index.html, and DIR/evaluation.json with every table.\n"
                              "Example: slalom reproduce --out drives/paper\n\n") +
                  kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return reproduce(*options); }; });
}

}  // namespace slalom::app
