#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "exit_code.hpp"
#include "slalom/io/sweep_report.hpp"

namespace slalom::app {

void add_study_report(CLI::App& app, Command& run) {
  auto folder = std::make_shared<std::string>();
  auto* command = app.add_subcommand("study-report", "Make the page of a sweep from its results");
  command->add_option("DIR", *folder, "Folder of a sweep")->required();
  command->footer(std::string("Leaves DIR/index.html and DIR/figures/. They take the place of "
                              "earlier ones.\n"
                              "Example: slalom study-report sweeps/paper\n\n") +
                  kExitCodeHelp);
  command->callback([folder, &run] {
    run = [folder] {
      write_or_fail([&] { io::write_sweep_report(*folder); });
      print(fmt::format("written to {}/index.html\n", *folder));
      return kOk;
    };
  });
}

}  // namespace slalom::app
