#pragma once

#include "options.hpp"

namespace slalom::app {

/// Each adds one sub-command to `app` and, when it is chosen, sets `run`.
void add_simulate(CLI::App& app, Command& run);
void add_plan(CLI::App& app, Command& run);
void add_lap(CLI::App& app, Command& run);
void add_reproduce(CLI::App& app, Command& run);
void add_sweep(CLI::App& app, Command& run);
void add_merge(CLI::App& app, Command& run);
void add_study_report(CLI::App& app, Command& run);
void add_replay(CLI::App& app, Command& run);
void add_compare(CLI::App& app, Command& run);
void add_make_scenarios(CLI::App& app, Command& run);
void add_import(CLI::App& app, Command& run);
void add_export(CLI::App& app, Command& run);
void add_check(CLI::App& app, Command& run);
void add_list(CLI::App& app, Command& run);
void add_problems(CLI::App& app, Command& run);
void add_docs(CLI::App& app, Command& run);

}  // namespace slalom::app
