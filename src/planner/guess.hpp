#pragma once

#include <vector>

#include "slalom/ocp/trajectory.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/planner/task.hpp"

namespace slalom::planner {

/// A plan from which the next solve may start.
struct LastPlan {
  double t_start = 0;          ///< absolute time of its first node [s]
  vehicle::State X0p{};        ///< the predicted state it was made for
  ocp::Trajectory trajectory;  ///< with its slacks
  bool in_range = false;       ///< of the goal
};

/// Where a solve starts (section 3, "Guess"): straight on from X0p at its heading and speed without
/// a last plan (speeding up from a crawl), else that plan from the new start on, resampled; slacks
/// inside their rows.
class Guess {
 public:
  explicit Guess(const Task& task)
      : settings_(task.planner), vehicle_(task.vehicle), goal_(task.goal) {}

  /// `last` may be null. The result, of full states and controls, lives until the next call.
  ocp::Trajectory& operator()(const Request& request, bool in_range, const LastPlan* last);

 private:
  void straight_on(const Request& request);
  void speeding_up(const Request& request);
  void shift(const Request& request, const LastPlan& last);
  void place_initial_slacks(const Request& request, const LastPlan* last);
  void place_final_slacks();
  double inside(double room, double weight) const;

  const Settings settings_;
  const vehicle::Parameters vehicle_;
  const world::Goal goal_;
  ocp::Trajectory guess_;
};

}  // namespace slalom::planner
