#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slalom/nlp/solver.hpp"
#include "slalom/vehicle/control_signal.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/pose.hpp"

namespace slalom::planner {

/// How planning ended: the solver's status, or one of the last four.
enum class PlanStatus {
  solved = static_cast<int>(nlp::Status::solved),
  iteration_limit = static_cast<int>(nlp::Status::iteration_limit),
  time_limit = static_cast<int>(nlp::Status::time_limit),
  infeasible = static_cast<int>(nlp::Status::infeasible),
  unbounded = static_cast<int>(nlp::Status::unbounded),
  invalid_number = static_cast<int>(nlp::Status::invalid_number),
  too_few_freedoms = static_cast<int>(nlp::Status::too_few_freedoms),
  interrupted = static_cast<int>(nlp::Status::interrupted),
  numerical_failure = static_cast<int>(nlp::Status::numerical_failure),
  not_confirmed,   ///< the solver says solved, but the residuals are too large
  no_prediction,   ///< the state to plan from could not be predicted
  unverified,      ///< the least bad motion, driven although it could not be verified
  passes_through,  ///< solved, but the plan goes through an obstacle or an edge between its nodes,
                   ///< or through an obstacle whose rows are soft at them
};
/// The word in files: the solver's word, "not_confirmed", "no prediction", "unverified" or
/// "passes_through".
const char* to_string(PlanStatus status);
/// The solver's status as a PlanStatus.
PlanStatus plan_status(nlp::Status status);

/// Where a plan goes into an obstacle's margin between its nodes; where rows are soft, also at
/// them.
struct Passage {
  double depth = 0;      ///< [m]; 0: nowhere
  std::string obstacle;  ///< its name
  double t = 0;          ///< absolute time [s]
  double at_nodes = 0;   ///< the deepest at a node, into any obstacle; 0 where rows are hard [m]

  /// How much deeper between the nodes than their rows know [m].
  double unseen() const { return depth - at_nodes; }
};

/// Where a plan leaves its road between its nodes.
struct RoadExit {
  double depth = 0;   ///< how far the footprint is beyond the edge [m]; 0: nowhere
  bool left = false;  ///< which edge
  double t = 0;       ///< absolute time [s]

  /// "left" or "right"; "" if there is no exit.
  const char* edge() const { return depth > 0 ? left ? "left" : "right" : ""; }
};

/// Residuals and cost of one solve, in the user's units.
struct SolveReport {
  bool solved = false;  ///< the solver says so, and so do the residuals below
  PlanStatus status = PlanStatus::numerical_failure;
  std::string
      detail;  ///< details of the status: why there is no prediction, or what the plan passes
  bool best_iterate = false;  ///< not solved, but within Request::best_iterate_tol: to be driven
  std::string backend;        ///< which solver answered
  int iterations = 0;
  double cpu_s = 0, wall_s = 0;  ///< thread time and wall clock of the solve
  double planning_cpu_s = 0;     ///< thread time of the cycle: update, guess, solve and check
  double cost = 0;
  std::vector<std::pair<std::string, double>> cost_terms;  ///< name, weighted value; sum = cost
  double phi = 0;                ///< barrier function f - mu sum log s at the floor
  double worst_violation = 0;    ///< largest constraint violation, in the constraint's unit
  std::string worst_constraint;  ///< its name, e.g. "obstacle[O2] at node 3"
  /// For a plan that is not solved, what is in the way, in metres if it is an obstacle; else empty.
  std::string blocks;
  double stationarity = 0;     ///< largest component of the Lagrangian's gradient
  double complementarity = 0;  ///< largest |s z / mu - 1|, or |s z| without floor
  Passage passage;             ///< the deepest, by the smaller of sm_start and sm_end
  RoadExit road_exit;          ///< the farthest

  /// The status as a word, followed by ": " and the detail if there is one.
  std::string status_text() const;
};

/// What a verifying planner knows about a plan: the believed plant, driven by the plan from the
/// predicted state, keeps `proved_clearance` from all predicted obstacles, and these wheel loads.
struct Certificate {
  bool verified = false;
  /// To the nearest obstacle's own edge at the instants that were looked at [m]; inf: no obstacle.
  double least_clearance = 0;
  /// What was proved for all instants between as well [m]: no point of the footprint comes nearer
  /// to any obstacle's own edge. Of a motion that is not verified, what was asked for.
  double proved_clearance = 0;
  std::string nearest;          ///< that obstacle's name
  double least_wheel_load = 0;  ///< [N]
  double until = 0;             ///< absolute time at which the motion ends [s]
  std::string refused;          ///< why it is not verified; empty if it is
  double refused_at = 0;        ///< absolute time of the first violation [s]
};

/// Where a plan of a verifying planner comes from, best first: a new motion; the rest of the last
/// plan, verified again; the least bad refused motion.
enum class Rung { none, new_plan, rest, least_bad };
/// "", "new", "rest" or "least_bad".
const char* to_string(Rung rung);

/// A motion that a verifying planner considered.
struct Candidate {
  std::string name;  ///< what it comes from, e.g. "way 2, solved"
  double cost = 0;   ///< to compare candidates, in the cost's unit; only verified ones have it
  Certificate certificate;
  /// Where it leads: some places of the front axle's centre, its first and last among them; none
  /// of a rest that is driven.
  std::vector<world::Point> path;
};

/// A planned trajectory at its mesh nodes. Controls are linear between nodes.
struct Plan {
  double t_start = 0;  ///< absolute time of node 0: t0 + tex [s]
  double tf = 0;       ///< duration [s]
  bool goal_in_range = false;
  std::vector<double> t;  ///< time since t_start, one per node: 0 at the first, tf at the last
  std::vector<vehicle::State> states;      ///< one per node
  std::vector<vehicle::Control> controls;  ///< one per node
  std::optional<double>
      obstacle_time_held;  ///< absolute time at which obstacles are held [s]; none: they move

  /// The absolute time at which obstacles are where node k meets them [s].
  double obstacle_time(std::size_t k) const { return obstacle_time_held.value_or(t_start + t[k]); }
  SolveReport report;

  // For verifying planners: where the plan comes from, its certificate, and all candidates.
  Rung rung = Rung::none;
  Certificate certificate;
  std::vector<Candidate> candidates;

  bool empty() const { return t.empty(); }
};

/// What would be driven in place of a new plan: the rest of the last one, if that is verified too;
/// else nullptr.
const Candidate* fallback(const Plan& plan);

/// Whether a plan can be driven: its times and controls make a valid signal. It need not be solved.
bool usable(const Plan& plan);
/// The controls of a usable plan, from plan.t_start on. Throws Error when it is not usable.
vehicle::ControlSignal control_signal(const Plan& plan);

}  // namespace slalom::planner
