#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "slalom/io/scenario_file.hpp"
#include "slalom/sim/drive.hpp"

namespace slalom::app {

/// What the chosen sub-command does once all arguments are read; returns the exit code.
using Command = std::function<int()>;

/// Options that sub-commands share.
struct CommonOptions {
  io::ScenarioRequest request;
  std::string out;
  std::vector<std::string> expect;
  bool json = false, quiet = false, force = false;

  bool writes() const { return !out.empty(); }
};

/// Which of the shared options a sub-command has.
void add_scenario(CLI::App& command, CommonOptions& options);  ///< SCENARIO
void add_overrides(CLI::App& command, CommonOptions& options,
                   bool with_files);                           ///< --planner --vehicle --tex --set
void add_output(CLI::App& command, CommonOptions& options);    ///< --out --force
void add_printing(CLI::App& command, CommonOptions& options);  ///< --json --quiet
void add_expect(CLI::App& command, CommonOptions& options, const std::string& outcomes);

/// For options that are real numbers: ranges let "nan" pass.
CLI::Validator no_nan();

/// Throws InvalidValue unless every expectation is one of `known`.
void check_expectations(const std::vector<std::string>& expect,
                        const std::vector<std::string>& known);

/// The exit code of a run that ended with `outcome`.
int exit_code_for(const std::string& outcome, const std::vector<std::string>& expect);

/// Runs what writes files; an Error becomes an OutputError, but for an InvalidValue, which is one
/// of the input.
void write_or_fail(const std::function<void()>& write);

/// Prints to stdout; throws OutputError when stdout takes no more.
void print(const std::string& text);
/// As --json has it. What is not UTF-8, as names of files need not be, becomes U+FFFD.
std::string text_of(const nlohmann::ordered_json& json);

}  // namespace slalom::app
