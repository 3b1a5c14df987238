#pragma once

#include <string>
#include <utility>
#include <vector>

#include "slalom/nlp/solver.hpp"
#include "slalom/vehicle/control_signal.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::planner {

/// How planning ended: as the solver did, unless the last two say otherwise.
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
  not_confirmed,   ///< the solver says solved, and the residuals deny it
  no_prediction,   ///< there was no state to plan from, for it could not be predicted
  unverified,      ///< the least bad motion, driven although it could not be verified
  passes_through,  ///< solved, and between its nodes the plan goes through an obstacle or an edge
};
/// The word that files have: the solver's, "not_confirmed" or "no prediction".
const char* to_string(PlanStatus status);
/// What the solver says, taken over.
PlanStatus plan_status(nlp::Status status);

/// Where a plan goes into an obstacle's margin between its nodes.
struct Passage {
  double depth = 0;      ///< [m]; 0: nowhere
  std::string obstacle;  ///< its name
  double t = 0;          ///< absolute time [s]
};

/// Where a plan leaves its road between its nodes.
struct RoadExit {
  double depth = 0;   ///< how far the footprint is beyond the edge [m]; 0: nowhere
  bool left = false;  ///< which edge
  double t = 0;       ///< absolute time [s]

  /// "left" or "right"; "" where there is none.
  const char* edge() const { return depth > 0 ? left ? "left" : "right" : ""; }
};

/// Residuals and cost of one solve, in the user's units.
struct SolveReport {
  bool solved = false;  ///< the solver says so, and so do the residuals below
  PlanStatus status = PlanStatus::numerical_failure;
  std::string
      detail;  ///< what the status leaves open: why there is no prediction, or what it passes
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
  /// Of a plan that is not solved, what is in the way, in metres where it is an obstacle; else
  /// empty.
  std::string blocks;
  double stationarity = 0;     ///< largest component of the Lagrangian's gradient
  double complementarity = 0;  ///< largest |s z / mu - 1|, or |s z| without floor
  Passage passage;             ///< the deepest, by the smaller of sm_start and sm_end
  RoadExit road_exit;          ///< the farthest

  /// The status in a word, with ": " and the detail behind it where there is one.
  std::string status_text() const;
};

/// What a planner that verifies its plans can say of one: that the plant as it is believed in,
/// driven by the plan from the state predicted, keeps these distances and loads from all obstacles
/// as they are predicted.
struct Certificate {
  bool verified = false;
  double least_clearance = 0;   ///< to the nearest edge of an obstacle, not grown [m]; inf: none
  std::string nearest;          ///< that obstacle's name
  double least_wheel_load = 0;  ///< [N]
  double until = 0;             ///< absolute time to which the motion is driven [s]
  std::string refused;          ///< why it is not verified; empty if it is
  double refused_at = 0;        ///< absolute time of that [s]
};

/// Where a plan of a verifying planner comes from, best first: a new motion; the rest of the last
/// one, verified anew; the least bad motion of those refused.
enum class Rung { none, new_plan, rest, least_bad };
/// "", "new", "rest" or "least_bad".
const char* to_string(Rung rung);

/// A motion that a verifying planner looked at.
struct Candidate {
  std::string name;  ///< what it comes from, e.g. "way 2, solved"
  double cost = 0;   ///< by which candidates are compared, in the cost's unit; verified ones only
  Certificate certificate;
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

  // Of planners that verify: where the plan comes from, what is known of it, and what else there
  // was.
  Rung rung = Rung::none;
  Certificate certificate;
  std::vector<Candidate> candidates;

  bool empty() const { return t.empty(); }
};

/// A plan can be driven: its times and controls are those of a signal. Whether the solver calls it
/// solved is another question.
bool usable(const Plan& plan);
/// The controls of a usable plan, from plan.t_start on. Throws Error when it is not usable.
vehicle::ControlSignal control_signal(const Plan& plan);

}  // namespace slalom::planner
