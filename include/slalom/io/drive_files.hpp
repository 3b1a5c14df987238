#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// Writes `text` to `path` whole or not at all: aside, flushed, then renamed. Throws Error (disk
/// full, no permission, ...) naming path and reason, and leaves nothing behind.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Creates (with parents) a folder for results; throws Error when it exists and holds results and
/// `force` is false, when it is a file, or when it cannot be written.
void prepare_folder(const std::filesystem::path& folder, bool force);

/// Writes plant.csv, plans.csv, cycles.csv, summary.json, resolved.yaml, report.html and the
/// figures of a drive into `folder` (made by prepare_folder). Results of another drive, plan or lap
/// that stand there go.
void write_drive(const std::filesystem::path& folder, const sim::Scenario& scenario,
                 const sim::Drive& drive);

/// Writes plan.csv (one row a node), plan.json and resolved.yaml of a single plan, in the place of
/// other results as write_drive() does. `warm_up` is the solve before it, or nullptr if there was
/// none.
void write_plan(const std::filesystem::path& folder, const sim::Scenario& scenario,
                const sim::Cycle& cycle, const sim::Cycle* warm_up);

/// The contents of single files, for tests and --json. A cell with a comma or quote is quoted.
/// plant_csv: t [s] absolute, the state, the control, wheel loads [N], clearance [m].
/// plans_csv, cycles_csv: the cycles on the clock, from 1; the warm-up solve stands in the summary.
std::string plant_csv(const sim::Drive& drive);
std::string plans_csv(const sim::Drive& drive);
std::string cycles_csv(const sim::Drive& drive);
std::string summary_json(const sim::Scenario& scenario, const sim::Drive& drive);
std::string plan_csv(const planner::Plan& plan);
std::string plan_json(const sim::Scenario& scenario, const sim::Cycle& cycle,
                      const sim::Cycle* warm_up);

}  // namespace slalom::io
