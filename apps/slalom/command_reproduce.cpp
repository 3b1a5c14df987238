#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "../../src/paper/paper_data.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "slalom/io/drive_files.hpp"
#include "slalom/sim/closed_loop.hpp"

namespace slalom::app {
namespace {

namespace fs = std::filesystem;
using Drives = std::vector<paper::ReproducedDrive>;

/// The drives of the paper's figures, then those of which its text alone speaks.
constexpr std::pair<const char*, const char*> kDrives[] = {
    {"E_A", "P_A"},          {"E_A", "P_B"},          {"E_A", "P_C"},
    {"E_A-figure", "P_A"},   {"E_A-figure", "P_B"},   {"E_A-figure", "P_C"},
    {"E_B", "P_C"},          {"E_B", "P_D"},          {"E_C", "P_C"},
    {"E_C", "P_D"},          {"E_C-range-50", "P_C"}, {"E_C-range-50", "P_D"},
    {"E_C-no-cones", "P_C"}, {"E_C-no-cones", "P_D"},
};

/// All scenarios, before the first is driven: a mistake in --set shows at once.
Drives load_all(const CommonOptions& options) {
  Drives drives;
  for (const auto& [environment, planner] : kDrives) {
    auto request = options.request;
    request.name_or_file = environment;
    request.planner = planner;
    drives.push_back({io::load_scenario(request), {}, fmt::format("{}/{}", environment, planner)});
  }
  return drives;
}

/// What the paper says of this drive, or nullptr.
const paper::PaperDrive* paper_of(const paper::PaperData& paper,
                                  const paper::ReproducedDrive& one) {
  for (const auto& drive : paper.drives)
    if (drive.environment + "/" + drive.planner == one.folder) return &drive;
  return nullptr;
}

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
class Reproduction {
 public:
  Reproduction(const CommonOptions& options, std::size_t count)
      : options_(options), text_(!options.quiet && !options.json), count_(count) {
    if (text_) print(table_head());
  }

  /// False when interrupted.
  bool drive(paper::ReproducedDrive& one, const paper::PaperDrive* printed) {
    Progress progress(fmt::format("{}/{} {}", ++index_, count_, one.folder), options_.quiet);
    sim::LoopHooks hooks;
    hooks.on_cycle = [&](const sim::Cycle& cycle) { progress.show(cycle); };
    hooks.interrupted = interrupted;
    one.drive = sim::drive(one.scenario, hooks);
    if (options_.writes())
      write_or_fail(
          [&] { io::write_drive(fs::path(options_.out) / one.folder, one.scenario, one.drive); });
    as_paper_ &= printed == nullptr || printed->outcome == sim::to_string(one.drive.outcome);
    if (text_) print(row(one, printed));
    json_.push_back(nlohmann::ordered_json::parse(io::summary_json(one.scenario, one.drive)));
    return one.drive.outcome != sim::Outcome::interrupted;
  }

  bool text() const { return text_; }
  bool as_paper() const { return as_paper_; }
  const nlohmann::ordered_json& json() const { return json_; }

 private:
  const CommonOptions& options_;
  bool text_, as_paper_ = true;
  std::size_t count_, index_ = 0;
  nlohmann::ordered_json json_ = nlohmann::ordered_json::array();
};

int reproduce(const CommonOptions& options) {
  check_expectations(options.expect, {"paper"});
  auto drives = load_all(options);
  auto cases = paper::load_concept_cases(options.request);
  const auto paper = paper::load_paper_data();
  std::vector<paper::ReproducedDrive*> all;
  for (auto& one : drives) all.push_back(&one);
  for (auto& one : cases) all.push_back(&one.driven);
  const fs::path out = options.out;
  if (options.writes())
    write_or_fail([&] {
      io::prepare_folder(out, options.force);
      for (const auto* one : all) io::prepare_folder(out / one->folder, options.force);
    });

  Reproduction reproduction(options, all.size());
  for (auto* one : all)
    if (!reproduction.drive(*one, paper_of(paper, *one))) {
      if (reproduction.text()) print("interrupted: the page of all drives is not written\n");
      return kInterrupted;
    }
  if (options.writes()) {
    write_or_fail([&] { paper::write_reproduction(out, drives, paper, cases); });
    if (reproduction.text()) print(fmt::format("written to {}\n", (out / "index.html").string()));
  }
  if (options.json) print(reproduction.json().dump(2) + "\n");
  return options.expect.empty() || reproduction.as_paper() ? kOk : kNotExpected;
}

}  // namespace

void add_reproduce(CLI::App& app, Command& run) {
  auto options = std::make_shared<CommonOptions>();
  auto* command =
      app.add_subcommand("reproduce", "Drive what the paper's figures and text show, and compare");
  add_overrides(*command, *options, false);
  add_output(*command, *options);
  add_printing(*command, *options);
  command
      ->add_option("--expect", options->expect,
                   "'paper': exit with 1 unless every drive ends as the paper's")
      ->type_name("paper");
  command->footer(std::string("Leaves DIR/SCENARIO/PLANNER/ and DIR/cases/LETTER/ for each drive,\n"
                              "and DIR/index.html.\n"
                              "Example: slalom reproduce --out drives/paper\n\n") +
                  kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return reproduce(*options); }; });
}

}  // namespace slalom::app
