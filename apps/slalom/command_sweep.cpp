#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "slalom/sweep/open_sweep.hpp"
#include "slalom/sweep/sweep.hpp"
#include "sweep_progress.hpp"
#include "worker_command.hpp"

namespace slalom::app {
namespace {

using Json = nlohmann::ordered_json;

struct SweepOptions {
  std::string study, out, shard = "1/1";
  std::vector<std::string> overrides;
  int jobs = 0;  ///< 0: one for each processor
  std::int64_t limit = -1;
  bool resume = false, force = false, json = false, quiet = false;
  std::string again;  ///< outcome of trials that are run again
};

/// i and n of "i/n".
std::pair<int, int> parse_shard(const std::string& text) {
  int i = 0, n = 0, end = 0;
  constexpr int kMost = 10000;
  if (std::sscanf(text.c_str(), "%5d/%5d%n", &i, &n, &end) != 2 ||
      end != static_cast<int>(text.size()) || n < 1 || n > kMost || i < 1 || i > n)
    throw InvalidValue("--shard", fmt::format("'{}'", text),
                       fmt::format("i/n with 1 <= i <= n <= {}, such as 2/4", kMost));
  return {i, n};
}

sweep::SweepRequest request_of(const SweepOptions& options) {
  sweep::SweepRequest request;
  request.out = options.out;
  request.jobs = options.jobs > 0
                     ? options.jobs
                     : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (options.limit >= 0) request.limit = options.limit;
  std::tie(request.shard, request.shards) = parse_shard(options.shard);
  request.resume = options.resume;
  request.force = options.force;
  request.again_failed = !options.again.empty();
  request.worker = worker_command();
  return request;
}

Json event_json(const sweep::SweepEvent& event) {
  using Kind = sweep::SweepEvent::Kind;
  switch (event.kind) {
    case Kind::begun:
      return {{"event", "begun"}, {"trials", event.total}, {"found_done", event.before}};
    case Kind::started:
      return {{"event", "started"},
              {"trial", event.trial},
              {"process", event.process},
              {"attempt", event.attempt}};
    case Kind::retried:
      return {{"event", "lost"}, {"trial", event.trial}, {"reason", event.reason}};
    case Kind::recorded:
      break;
  }
  const auto& r = *event.record;
  Json json = {{"event", "recorded"},  {"trial", event.trial}, {"scenario", r.scenario},
               {"planner", r.planner}, {"values", r.values},   {"outcome", r.outcome}};
  json["time_s"] = std::isfinite(r.time) ? Json(r.time) : Json(nullptr);
  if (r.outcome == "failed" || r.outcome == "invalid") json["reason"] = r.message;
  return json;
}

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string end_text(const SweepOptions& options, const sweep::SweepSummary& s) {
  auto text = fmt::format("{} trials: {} run now", s.total, s.done);
  if (s.before > 0) text += fmt::format(", {} found done", s.before);
  if (s.failed > 0) text += fmt::format(", {} failed (see the column message)", s.failed);
  if (s.pending > 0) text += fmt::format(", {} left", s.pending);
  if (s.killed > 0)
    text += fmt::format(" ({} of them since their processes were killed)", s.killed);
  text += fmt::format("\nwritten to {}/trials.csv\n", options.out);
  if (s.pending > 0) text += "run the same command again to go on\n";
  return text;
}

int sweep(const SweepOptions& options) {
  poll_interrupts();
  auto request = request_of(options);
  const auto study = sweep::load_study(options.study, options.overrides);
  SweepProgress progress(study.name, options.quiet);
  sweep::SweepHooks hooks;
  hooks.on_event = [&](const sweep::SweepEvent& event) {
    progress.take(event);
    if (options.json) print(line_of(event_json(event)));
  };
  hooks.tick = [&] { progress.tick(); };
  hooks.interrupted = interrupted;
  sweep::SweepSummary summary;
  write_or_fail([&] { summary = sweep::run_sweep(study, request, hooks); });
  progress.clear();
  if (options.json)
    print(line_of({{"event", "ended"},
                   {"interrupted", summary.interrupted},
                   {"trials", summary.total},
                   {"found_done", summary.before},
                   {"run", summary.done},
                   {"failed", summary.failed},
                   {"left", summary.pending},
                   {"killed", summary.killed}}));
  else if (!options.quiet)
    print(end_text(options, summary));
  return summary.interrupted || summary.killed > 0 ? kInterrupted : kOk;
}

void add_worker(CLI::App& app, Command& run) {
  // Not shown: a sweep starts it.
  auto* command = app.add_subcommand("sweep-worker", "Run the trials that come on standard input");
  command->group("");
  command->callback([&run] {
    run = [] {
      sweep::serve_trials();
      return kOk;
    };
  });
}

}  // namespace

void add_sweep(CLI::App& app, Command& run) {
  auto options = std::make_shared<SweepOptions>();
  auto* command = app.add_subcommand("sweep", "Drive all trials of a study on several processes");
  command->add_option("STUDY", options->study, "Built-in study (see 'slalom list') or a YAML file")
      ->required();
  command->add_option("--out", options->out, "Folder for the results; goes on where it holds some")
      ->type_name("DIR")
      ->required()
      ->check([](const std::string& text) {
        return text.empty() ? std::string("found '', expected a folder") : std::string();
      });
  command
      ->add_option("--jobs", options->jobs, "Worker processes; by default one for each processor")
      ->check(CLI::Range(1, 1024));
  command->add_option("--limit", options->limit, "Run at most so many trials now")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
  command->add_option("--shard", options->shard, "Run only every n-th trial, from the i-th on")
      ->type_name("i/n");
  command
      ->add_option("--set", options->overrides,
                   "Set any key for all trials, e.g. --set planner.w_t=50")
      ->allow_extra_args(false)
      ->type_name("KEY.PATH=VALUE");
  auto* resume = command->add_flag("--resume", options->resume,
                                   "Refuse to begin anew: DIR must hold this study already");
  auto* force =
      command->add_flag("--force", options->force, "Replace what another sweep left in DIR");
  force->excludes(resume);
  command
      ->add_option("--again", options->again,
                   "Run the trials again that DIR holds as failed; the others stay")
      ->type_name("failed")
      ->check(CLI::IsMember({"failed"}))
      ->excludes(force);
  auto* json = command->add_flag("--json", options->json, "Print each event as a line of JSON");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors")->excludes(json);
  command->footer(
      std::string("Trials that DIR holds already are not run again. A trial whose process dies or\n"
                  "hangs is tried again and at last recorded as failed; a trial whose process\n"
                  "something else kills is left to the next run.\n"
                  "Example: slalom sweep paper --out sweeps/paper\n\n") +
      kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return sweep(*options); }; });
  add_worker(app, run);
}

}  // namespace slalom::app
