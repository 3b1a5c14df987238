#pragma once

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/variant.h>

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "binding.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::python {

/// A scenario as Python gives it: loaded, as a dict with the keys of a scenario file, or by the
/// name of a built-in one or of a file.
using ScenarioChoice = std::variant<sim::Scenario, ByName<nb::any>, std::filesystem::path>;

/// What differs from the scenario: a planner's name or file, an execution horizon [s], values by
/// key, and a vehicle's name or file.
struct Changes {
  std::optional<std::string> planner;
  std::optional<double> tex;
  nb::dict set;
  std::optional<std::string> vehicle = {};

  bool none() const { return !planner && !tex && set.size() == 0 && !vehicle; }
};

/// Throws InvalidValue for what is no scenario.
sim::Scenario scenario_of(const ScenarioChoice& choice, const Changes& changes);

void bind_road(nb::module_& module);

}  // namespace slalom::python
