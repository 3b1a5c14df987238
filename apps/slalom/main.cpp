#include <fmt/format.h>
#include <fmt/ranges.h>

#include <csignal>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "slalom/base/options.hpp"
#include "slalom/io/version.hpp"

namespace {

using namespace slalom;

/// Prints a message on one line, whatever it quotes: a key may hold a line break, or worse.
int fail(int code, const std::string& message) {
  std::string line;
  for (const char c : message) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte == 0x7F ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  fmt::print(stderr, "slalom: {}\n", line);
  return code;
}

/// A message when `word` names no sub-command; CLI11 would only say that one is missing.
std::optional<std::string> unknown_command(const CLI::App& cli, const std::string& word) {
  std::vector<std::string> names;
  for (const auto* command : cli.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == word) return std::nullopt;
    if (!command->get_group().empty()) names.push_back(command->get_name());
  }
  return fmt::format("found '{}', expected {}", word, one_of(word, names));
}

/// Reads the arguments into `run`; an exit code when there is nothing to run.
std::optional<int> parse(CLI::App& cli, int argc, char** argv) {
  if (argc > 1 && argv[1][0] != '-')
    if (const auto message = unknown_command(cli, argv[1])) return fail(app::kBadInput, *message);
  try {
    cli.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::Success& request) {  // --help, --version
    cli.exit(request);
    return app::kOk;
  } catch (const CLI::ParseError& error) {
    return fail(app::kBadInput, fmt::format("{} (see 'slalom --help')", error.what()));
  }
}

int run_app(int argc, char** argv) {
  CLI::App cli("Slalom plans and drives a vehicle around obstacles at its dynamic limits.");
  cli.name("slalom");
  cli.set_version_flag("--version", std::string("slalom ") + io::kVersion);
  cli.require_subcommand(1);
  cli.footer(std::string("Start with: slalom simulate E_B --out drives/E_B\n\n") +
             app::kExitCodeHelp);
  app::Command run;
  app::add_simulate(cli, run);
  app::add_plan(cli, run);
  app::add_lap(cli, run);
  app::add_reproduce(cli, run);
  app::add_sweep(cli, run);
  app::add_merge(cli, run);
  app::add_study_report(cli, run);
  app::add_replay(cli, run);
  app::add_compare(cli, run);
  app::add_make_scenarios(cli, run);
  app::add_import(cli, run);
  app::add_export(cli, run);
  app::add_check(cli, run);
  app::add_list(cli, run);
  app::add_problems(cli, run);
  app::add_docs(cli, run);
  if (const auto code = parse(cli, argc, argv)) return *code;
  return run();
}

}  // namespace

int main(int argc, char** argv) {
  // A file beyond the allowed size is then an error of the write, with a message.
  std::signal(SIGXFSZ, SIG_IGN);
  app::catch_interrupts();
  try {
    return run_app(argc, argv);
  } catch (const app::OutputError& error) {
    return fail(app::kNotWritten, error.what());
  } catch (const Error& error) {
    return fail(app::kBadInput, error.what());
  } catch (const std::exception& error) {
    return fail(app::kInternal, fmt::format("internal error: {}", error.what()));
  } catch (...) {
    return fail(app::kInternal, "internal error");
  }
}
