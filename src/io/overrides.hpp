#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "section.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// Applies "key.path=value" from the command line: planner.w_t=50, loop.tex=.25, vehicle.m=3000,
/// start.x=6.1, goal.sigma=5, region.x_min=0, obstacles.O2.vy=-20, title=text. Throws InvalidValue
/// naming "--set key.path".
void apply_override(const std::string& assignment, sim::Scenario& scenario, Places& places);
/// The same for a key path and a value that stand in a file; throws InvalidValue naming their
/// places.
void apply_setting(const std::string& path, const Place& place, const Value& value,
                   sim::Scenario& scenario, Places& places);

/// The vehicle's settings that assignments or key paths name, without their section.
std::set<std::string> stated_of_vehicle(const std::vector<std::string>& assignments);

/// The settings that a key path sets, by the paths under which files are written: obstacles.O1.a
/// and .b for obstacles.O1.r, start.psi for start.psi_deg; else the path itself.
std::vector<std::string> settings_at(const std::string& path);

/// The option that a key path names, but for obstacles and the scenario's name and title; nothing
/// where there is none.
std::optional<OptionInfo> option_at(const std::string& path, sim::Scenario scenario);

/// Sets each of several values of one key, one after the other, for what is thrown alone.
void try_settings(const std::string& path, const Place& place,
                  const std::vector<const Value*>& values, sim::Scenario scenario);

}  // namespace slalom::io
