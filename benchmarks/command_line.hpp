#pragma once

#include <CLI/CLI.hpp>
#include <cstdlib>

namespace slalom::bench {

/// Fills what `app`'s options are bound to. For --help and mistakes, says so and ends the program.
inline void parse_or_exit(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
}

}  // namespace slalom::bench
