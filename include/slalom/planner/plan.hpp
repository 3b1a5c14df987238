#pragma once

#include <string>
#include <utility>
#include <vector>

#include "slalom/vehicle/state.hpp"

namespace slalom::planner {

/// Residuals and cost of one solve, in the user's units.
struct SolveReport {
  bool solved = false;        ///< the solver says so, and so do the residuals below
  std::string status;         ///< of the solver; "not_confirmed" where the residuals deny it
  bool best_iterate = false;  ///< not solved, and within Request::best_iterate_tol: to be driven
  std::string backend;        ///< which solver answered
  int iterations = 0;
  double cpu_s = 0, wall_s = 0;  ///< thread time and wall clock of the solve
  double planning_cpu_s = 0;     ///< thread time of the cycle: update, guess, solve and check
  double cost = 0;
  std::vector<std::pair<std::string, double>> cost_terms;  ///< name, weighted value; sum = cost
  double phi = 0;                ///< barrier function f - mu sum log s at the floor
  double worst_violation = 0;    ///< largest constraint violation, in the constraint's unit
  std::string worst_constraint;  ///< its name, e.g. "obstacle[O2] at node 3"
  double stationarity = 0;       ///< largest component of the Lagrangian's gradient
  double complementarity = 0;    ///< largest |s z / mu - 1|, or |s z| without floor
};

/// A planned trajectory at its mesh nodes. Controls are linear between nodes.
struct Plan {
  double t_start = 0;  ///< absolute time of node 0: t0 + tex [s]
  double tf = 0;       ///< duration [s]
  bool goal_in_range = false;
  std::vector<double> t;  ///< time since t_start, one per node, t.front() = 0, t.back() = tf
  std::vector<vehicle::State> states;      ///< one per node
  std::vector<vehicle::Control> controls;  ///< one per node
  double obstacle_time_held = -1;  ///< absolute time at which obstacles are held; < 0: they move
  SolveReport report;

  bool empty() const { return t.empty(); }
};

}  // namespace slalom::planner
