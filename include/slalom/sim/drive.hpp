#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "slalom/planner/plan.hpp"
#include "slalom/vehicle/state.hpp"

namespace slalom::sim {

enum class Outcome {
  goal,
  crash,
  wheel_lift,
  off_road,
  not_optimal,
  solve_time,
  timeout,
  interrupted
};

/// "goal", "crash", ... as files have it.
const char* to_string(Outcome outcome);
/// All names, in the enum's order.
const std::vector<std::string>& outcome_names();

/// One recorded instant of the plant. Linear interpolation of the samples' controls is the control
/// the plant drove: where signals swap, the sample at the swap has the new signal's control and one
/// a nanosecond before it the old one's.
struct PlantSample {
  double t = 0;  ///< absolute time [s]
  vehicle::State state{};
  vehicle::Control control{};
  vehicle::WheelLoads wheel_loads{};  ///< [N]
  double clearance = 0;  ///< signed distance to the nearest grown obstacle's edge [m]; inf if none
};

/// One planning cycle.
struct Cycle {
  int index = 0;          ///< 1 is the first; 0 the warm-up solve, if any
  double t0 = 0;          ///< when planning started [s]
  double tex = 0;         ///< execution horizon [s]
  double solve_time = 0;  ///< of planning, by the clock or a scripted latency rule [s]
  double charged = 0;     ///< time until the plan was there, by the latency rule [s]
  double t_swap = 0;      ///< when the plan took effect, or would have [s]
  vehicle::State X0p{};   ///< state from which it plans: predicted for t0 + tex, unless instant
  planner::Plan plan;     ///< with its solve report; nodes as the solver left them
  bool late = false;      ///< of a planner that verifies: the plan was there too late to be driven
  bool used = false;      ///< the plant took this plan over at t_swap (false: warm-up, failed,
                          ///< late, or the drive ended first)
};

/// A closed-loop drive.
struct Drive {
  Outcome outcome = Outcome::timeout;
  double time = 0;  ///< when the drive ended [s]
  /// When the goal was first reached, a square entered [s], located in time; the drive goes on to
  /// the check at the end of the execution horizon, and may fail on the way or have left the square
  /// by then.
  std::optional<double> goal_time;
  std::string hit;             ///< obstacle hit, or wheel that lifted; empty otherwise
  std::string message;         ///< one sentence on how it ended
  double least_clearance = 0;  ///< over the drive [m]
  double least_clearance_t = 0;
  std::string least_clearance_obstacle;
  double least_wheel_load = 0;  ///< [N]
  /// Of the footprint from the road's edge, at samples [m]; infinite without a road.
  double least_edge_distance = std::numeric_limits<double>::infinity();
  double progress = 0;           ///< along the road from the start to the end of the drive [m]
  std::vector<double> lap_ends;  ///< when each lap of a closed road was done [s]
  std::vector<PlantSample> plant;
  std::vector<Cycle> cycles;
};

}  // namespace slalom::sim
