#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "exit_code.hpp"
#include "slalom/sweep/sweep.hpp"

namespace slalom::app {
namespace {

struct MergeOptions {
  std::vector<std::string> from;
  std::string out;
  bool force = false, json = false, quiet = false;
};

int merge(const MergeOptions& options) {
  sweep::SweepContent merged;
  write_or_fail([&] {
    merged =
        sweep::merge_sweeps({options.from.begin(), options.from.end()}, options.out, options.force);
  });
  const auto& study = merged.study;
  if (options.json)
    print(text_of({{"study", study.name},
                   {"trials", study.size},
                   {"merged", merged.trials},
                   {"missing", study.size - merged.trials}}));
  else if (!options.quiet)
    print(fmt::format("{} of {} trials of {}, written to {}/trials.csv\n", merged.trials,
                      study.size, study.name, options.out));
  return kOk;
}

}  // namespace

void add_merge(CLI::App& app, Command& run) {
  auto options = std::make_shared<MergeOptions>();
  auto* command =
      app.add_subcommand("merge", "Put the results of a study's shards into one folder");
  command->add_option("DIR", options->from, "Folders of sweeps of one study")->required();
  command->add_option("--out", options->out, "Folder for all results")
      ->type_name("DIR")
      ->required()
      ->check([](const std::string& text) {
        return text.empty() ? std::string("found '', expected a folder") : std::string();
      });
  command->add_flag("--force", options->force, "Replace what another sweep left there");
  auto* json = command->add_flag("--json", options->json, "Print the result as JSON");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors")->excludes(json);
  command->footer(std::string("Example: slalom merge s1 s2 s3 s4 --out all\n\n") + kExitCodeHelp);
  command->callback([options, &run] { run = [options] { return merge(*options); }; });
}

}  // namespace slalom::app
