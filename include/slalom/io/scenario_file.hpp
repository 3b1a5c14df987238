#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// A scenario as the command line asks for it.
struct ScenarioRequest {
  std::string name_or_file;                 ///< built-in name (E_A, E_A-figure, E_B, E_C) or a path
  std::optional<std::string> planner;       ///< built-in planner name or file; overrides the file's
  std::optional<double> tex;                ///< [s]
  std::vector<std::string> overrides;       ///< "key.path=value", applied last, in order
  std::optional<std::string> vehicle = {};  ///< likewise a built-in vehicle's name or a file
};

/// Reads, overrides and checks a scenario. Throws InvalidValue with file:line:column (or
/// "--set key.path" for overrides), what was found and what was expected; unknown keys name the
/// nearest known one.
sim::Scenario load_scenario(const ScenarioRequest& request);
/// The same, with what a reader of the scenario should know of it in sentences: what its vehicle
/// takes from the one that it is based on, and sim::advice().
sim::Scenario load_scenario(const ScenarioRequest& request, std::vector<std::string>& advice);

/// The same for the text of a scenario file that came from `source`.
sim::Scenario parse_scenario(const std::string& text, const std::string& source);
/// Likewise, with a request's planner, vehicle, tex and overrides; its name_or_file says where the
/// text came from.
sim::Scenario parse_scenario(const std::string& text, const ScenarioRequest& request);

/// One obstacle by the keys of a scenario file, a map as YAML or JSON; `source` names it in
/// messages. A file that it names counts from the working directory. Throws InvalidValue.
world::Obstacle parse_obstacle(const std::string& text, const std::string& source);

/// The whole scenario as one YAML file that load_scenario reads back to the same bits.
std::string to_yaml(const sim::Scenario& scenario);
/// The same without what follows from other values (Scenario::sm_crash_follows): read with changes
/// of those, it is what the scenario's own file would be with them.
std::string to_yaml_as_stated(const sim::Scenario& scenario);

/// All values by the key that sets them ("planner.w_t", "start.ux", "obstacles.O2.vy"), in the
/// order of files, obstacles last. Sides that the region has not are infinite.
std::vector<std::pair<std::string, OptionValue>> values_of(const sim::Scenario& scenario);

/// A built-in configuration file.
struct BuiltIn {
  std::string name;
  std::string title;
  std::string path;
};
std::vector<BuiltIn> built_in_scenarios();
std::vector<BuiltIn> built_in_planners();
std::vector<BuiltIn> built_in_vehicles();
std::vector<BuiltIn> built_in_studies();

/// Markdown reference of every key, generated from the option tables (docs/scenario-reference.md).
std::string scenario_reference();
/// The options of solvers, as Markdown; docs/solver-options.md.
std::string solver_options_page();

}  // namespace slalom::io
