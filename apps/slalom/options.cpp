#include "options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "exit_code.hpp"
#include "slalom/base/options.hpp"

namespace slalom::app {

void add_scenario(CLI::App& command, CommonOptions& options) {
  command
      .add_option("SCENARIO", options.request.name_or_file,
                  "Built-in scenario (see 'slalom list') or a YAML file")
      ->required();
}

void add_overrides(CLI::App& command, CommonOptions& options, bool with_files) {
  if (with_files) {
    command.add_option("--planner", options.request.planner,
                       "Built-in planner or a file, instead of the scenario's own");
    command.add_option("--vehicle", options.request.vehicle,
                       "Built-in vehicle or a file, instead of the scenario's own");
  }
  command.add_option("--tex", options.request.tex, "Execution horizon [s]");
  // One value an option: a list would swallow what follows it.
  command
      .add_option("--set", options.request.overrides,
                  "Set any key, e.g. --set planner.w_t=50 --set obstacles.O2.vy=-20; may be given "
                  "several times")
      ->allow_extra_args(false)
      ->type_name("KEY.PATH=VALUE");
}

void add_output(CLI::App& command, CommonOptions& options) {
  command.add_option("--out", options.out, "Folder for all results; without it none are written")
      ->type_name("DIR")
      // An unset variable of a script must not mean "write nothing".
      ->check([](const std::string& text) {
        return text.empty() ? std::string("found '', expected a folder") : std::string();
      });
  command.add_flag("--force", options.force, "Replace results that stand in the folder already");
}

void add_printing(CLI::App& command, CommonOptions& options) {
  auto* json = command.add_flag("--json", options.json, "Print the result as JSON");
  command.add_flag("--quiet", options.quiet, "Print nothing but errors")->excludes(json);
}

void add_expect(CLI::App& command, CommonOptions& options, const std::string& outcomes) {
  command
      .add_option("--expect", options.expect,
                  "Exit with 1 unless the outcome is one of these: " + outcomes)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("OUTCOME[,...]");
}

CLI::Validator no_nan() {
  return CLI::Validator(
      [](std::string& text) {
        double number = 0;
        const bool is_nan = CLI::detail::lexical_cast(text, number) && std::isnan(number);
        return is_nan ? fmt::format("found '{}', expected a number", text) : std::string();
      },
      "", "no_nan");
}

void check_expectations(const std::vector<std::string>& expect,
                        const std::vector<std::string>& known) {
  for (const auto& word : expect)
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw InvalidValue("--expect", fmt::format("'{}'", word), one_of(word, known));
}

int exit_code_for(const std::string& outcome, const std::vector<std::string>& expect) {
  if (std::find(expect.begin(), expect.end(), outcome) != expect.end()) return kOk;
  if (outcome == "interrupted") return kInterrupted;
  return expect.empty() ? kOk : kNotExpected;
}

void write_or_fail(const std::function<void()>& write) {
  try {
    write();
  } catch (const InvalidValue&) {
    throw;  // what was given is at fault, not where it goes
  } catch (const Error& error) {
    throw OutputError(error.what());
  }
}

void print(const std::string& text) {
  errno = 0;
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!whole || std::fflush(stdout) != 0)
    throw OutputError(fmt::format("standard output: cannot be written ({})", std::strerror(errno)));
}

std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace slalom::app
