#pragma once

#include <string>
#include <vector>

#include "section.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::io {

/// A section of a scenario file.
struct ScenarioSection {
  /// How resolved files have it: in one line, a line a key, a list of lines, or as a road.
  enum class Form { flow, block, list, road };

  std::string name;
  Form form = Form::block;
  bool in_files = false;  ///< it may name a file of its own, over which its keys are read
  std::vector<std::string> required = {};  ///< keys that must be there, and the section with them
  std::vector<std::string> instead = {};   ///< of which one may stand for those required
  std::vector<std::string> beside = {};    ///< that say nothing without those required
  std::string about;                       ///< in the reference
  /// Its keys, bound to their part of a scenario. A list and a road have none of their own.
  Section (*bind)(sim::Scenario&) = nullptr;
};

/// All of them, in the order in which files are written and the reference describes them. What is
/// read, what --set takes, what is written and what the reference says follow from this table.
const std::vector<ScenarioSection>& scenario_sections();
/// The one of that name that has keys of its own, or nullptr.
const ScenarioSection* find_section(const std::string& name);
std::vector<std::string> section_names();
/// Every key a scenario file may have.
std::vector<std::string> scenario_keys();

/// The shortest decimal that reads back to the same bits, as YAML has it.
std::string yaml_number(double number);
/// A list of lists of such.
std::string yaml_rows(const std::vector<std::vector<double>>& rows,
                      const std::string& between = ", ");

/// The options of one obstacle, and its radius r.
Section obstacle_section(world::Obstacle& obstacle, const std::string& path);

/// An obstacle as files write it, once or in a row. Its polygon, table and path are lists, which
/// the reader takes itself.
struct ObstacleEntry {
  world::Obstacle obstacle;
  double length = 1, width = 1;  ///< of a box [m]
  double speed = 0;              ///< along a path [m/s]
  double acceleration = 0;       ///< [m/s^2]
  world::BeyondEnd before = world::BeyondEnd::stands, after = world::BeyondEnd::goes_on;
  int repeat = 1;
  std::array<double, 2> step = {0, 0};  ///< from one to the next [m]
};
/// The section of an obstacle with all keys that are no lists.
Section entry_section(ObstacleEntry& entry);

}  // namespace slalom::io
