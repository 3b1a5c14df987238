#pragma once

#include "line_problem.hpp"
#include "slalom/ocp/solve.hpp"
#include "slalom/planner/lap.hpp"
#include "slalom/vehicle/parameters.hpp"
#include "slalom/world/road.hpp"

namespace slalom::planner {

/// The fastest flying lap as a problem along the line that ends as it begins, and how it is solved
/// on one mesh. The road outlives it.
class LapProblem {
 public:
  /// Throws InvalidValue as fastest_lap() does.
  LapProblem(const world::Road& road, const vehicle::Parameters& vehicle,
             const LapSettings& settings);

  const LineProblem& line() const { return line_; }
  const ocp::Problem& problem() const { return line_.problem(); }
  /// Guess and options of a solve on that many uniform intervals.
  ocp::SolveSettings solve_on(int intervals) const;

 private:
  LineProblem line_;
  ocp::SolveSettings solve_;
};

}  // namespace slalom::planner
