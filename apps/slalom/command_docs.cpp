#include "all_problems.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "slalom/problems/page.hpp"

namespace slalom::app {

void add_docs(CLI::App& app, Command& run) {
  // Not shown: it serves those who build the documentation.
  auto* command = app.add_subcommand("docs", "Print a generated page of the documentation");
  command->group("");
  command->require_subcommand(1);
  command->add_subcommand("scenario-reference", "Every key of a scenario file, as Markdown")
      ->callback([&run] {
        run = [] {
          print(io::scenario_reference());
          return kOk;
        };
      });
  command->add_subcommand("problems", "The library of problems, as Markdown")->callback([&run] {
    run = [] {
      print(problems::page(all_problems()));
      return kOk;
    };
  });
  command->add_subcommand("solver-options", "Every option of a solver, as Markdown")
      ->callback([&run] {
        run = [] {
          print(io::solver_options_page());
          return kOk;
        };
      });
}

}  // namespace slalom::app
