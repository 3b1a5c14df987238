#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planner_cycle.hpp"
#include "slalom/nlp/check.hpp"

namespace slalom::bench {

/// A recorded planning cycle.
struct Cycle {
  planner::Request request;
  bool in_range = false;
  bool solved = false;  ///< when it was recorded
  int drive = 0;        ///< number of its drive; cycles of one stand together
  bool perturbed = false;
  std::optional<Last> last;    ///< none: from straight on
  std::vector<double> warm_x;  ///< the shifted start, user's units (cold_x without a last plan)
  std::vector<double> cold_x;  ///< from straight on, user's units
};

/// Sets the form and both starts from the request and the last plan.
void place_starts(PlannerCycle& planner, Cycle& cycle);

/// Cycles of one environment in one file, for programs in C++ and Python (cycles.py): a line of
/// JSON with the names of both forms' variables and rows, then for each cycle the arrays that
/// `fields` in cycle_file.cpp lists, as doubles, each after its length. Multipliers in user's
/// units.
void write_cycles(const std::string& path, PlannerCycle& planner, const std::string& environment,
                  const std::vector<Cycle>& cycles);
/// Throws InvalidValue for a file that cannot be read or ends early.
std::vector<Cycle> read_cycles(const std::string& path, PlannerCycle& planner);

/// x in the user's units.
std::vector<double> in_user_units(const std::vector<double>& x, const nlp::Structure& shape);

/// What run.py judges an answer by: residuals, f, phi, tf, and x and y node by node.
nlohmann::json describe(const nlp::Residuals& residuals, const ocp::Trajectory& trajectory);

}  // namespace slalom::bench
