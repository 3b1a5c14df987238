#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "exit_code.hpp"
#include "slalom/io/recording_file.hpp"

namespace slalom::app {
namespace {

struct ReplayOptions {
  std::string file;
  CommonOptions common;
};

std::string text(const io::RecordedSolve& solve, const planner::Replayed& replayed) {
  const auto& recorded = solve.recording;
  const auto line = [](const char* who, nlp::Status status, int iterations, double phi) {
    return fmt::format("  {:<10} {} after {} iterations, phi {}\n", who, nlp::to_string(status),
                       iterations, phi);
  };
  return fmt::format("{} {}, planned at {} s, kernel set {}\n", solve.scenario.name,
                     solve.scenario.planner.name, recorded.t0, to_string(recorded.kernels)) +
         line("recorded", recorded.status, recorded.iterations, recorded.phi) +
         line("replayed", replayed.status, replayed.iterations, replayed.phi) +
         (replayed.same ? "  the same to the last bit\n" : "  NOT the same\n");
}

std::string json_text(const io::RecordedSolve& solve, const planner::Replayed& replayed) {
  const auto one = [](nlp::Status status, int iterations, double phi) {
    nlohmann::ordered_json json;
    json["status"] = nlp::to_string(status);
    json["iterations"] = iterations;
    json["phi"] = std::isfinite(phi) ? nlohmann::ordered_json(phi) : nullptr;
    return json;
  };
  const auto& recorded = solve.recording;
  nlohmann::ordered_json json;
  json["scenario"] = solve.scenario.name;
  json["planner"] = solve.scenario.planner.name;
  json["t0_s"] = recorded.t0;
  json["kernels"] = to_string(recorded.kernels);
  json["recorded"] = one(recorded.status, recorded.iterations, recorded.phi);
  json["replayed"] = one(replayed.status, replayed.iterations, replayed.phi);
  json["same"] = replayed.same;
  return text_of(json);
}

nlohmann::ordered_json json_of(const planner::Certificate& c) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nullptr;
  };
  return {{"verified", c.verified},     {"least_clearance_m", number(c.least_clearance)},
          {"nearest", c.nearest},       {"least_wheel_load_N", number(c.least_wheel_load)},
          {"until_s", number(c.until)}, {"refused", c.refused}};
}

/// Verifies a recorded plan again.
int replay(const io::RecordedMotion& motion, const CommonOptions& options) {
  const auto& recorded = motion.plan.certificate;
  const auto again = planner::verify_again(motion.plan, motion.scenario);
  const bool same = planner::same(recorded, again);
  if (options.json) {
    nlohmann::ordered_json json;
    json["scenario"] = motion.scenario.name;
    json["planner"] = motion.scenario.planner.name;
    json["t0_s"] = motion.plan.t0;
    json["rung"] = to_string(motion.plan.rung);
    json["recorded"] = json_of(recorded);
    json["replayed"] = json_of(again);
    json["same"] = same;
    print(text_of(json));
  } else if (!options.quiet) {
    const auto line = [](const char* who, const planner::Certificate& c) {
      return fmt::format("  {:<10} {}, {} m to {}, {} N\n", who,
                         c.verified ? "verified" : "refused: " + c.refused, c.least_clearance,
                         c.nearest.empty() ? "no obstacle" : c.nearest, c.least_wheel_load);
    };
    print(fmt::format("{} {}, planned at {} s\n", motion.scenario.name,
                      motion.scenario.planner.name, motion.plan.t0) +
          line("recorded", recorded) + line("replayed", again) +
          (same ? "  the same to the last bit\n" : "  NOT the same\n"));
  }
  return same ? kOk : kNotExpected;
}

int replay(const ReplayOptions& options) {
  const auto recorded = io::read_recording(options.file);
  if (const auto* motion = std::get_if<io::RecordedMotion>(&recorded))
    return replay(*motion, options.common);
  const auto& solve = std::get<io::RecordedSolve>(recorded);
  const auto replayed = planner::replay(solve.recording, solve.scenario);
  if (options.common.json) {
    print(json_text(solve, replayed));
  } else if (!options.common.quiet) {
    print(text(solve, replayed));
  }
  return replayed.same ? kOk : kNotExpected;
}

}  // namespace

void add_replay(CLI::App& app, Command& run) {
  auto options = std::make_shared<ReplayOptions>();
  auto* command = app.add_subcommand(
      "replay", "Solve a recorded solve again, or verify a recorded plan, and compare the bits");
  command
      ->add_option("FILE", options->file,
                   "A recorded solve or plan, from 'slalom simulate --record-failures'")
      ->required();
  add_printing(*command, options->common);
  command->footer(std::string("Exits with 0 when the answer is the same to the last bit, else 1.\n"
                              "Example: slalom replay failures/cycle-12.json\n\n") +
                  kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return replay(*options); }; });
}

}  // namespace slalom::app
