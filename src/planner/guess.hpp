#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "drivable_speed.hpp"
#include "road_way.hpp"
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
/// a last plan (speeding up from a crawl), or along the road, no faster at its end than the road's
/// bends allow; else that plan from the new start on, resampled; slacks inside their rows.
class Guess {
 public:
  explicit Guess(const Task& task);

  /// `last` may be null; `way` is of the road alone but for whether the goal is in range. The
  /// result, of full states and controls, lives until the next call.
  ocp::Trajectory& operator()(const Request& request, const WayAhead& way, const LastPlan* last);

 private:
  void along_road(const Request& request, const WayAhead& way);
  double length_of(const WayAhead& way) const;
  double slowest_ahead(const WayAhead& way) const;
  void straight_on(const Request& request);
  void speeding_up(const Request& request);
  void shift(const Request& request, const LastPlan& last);
  void place_initial_slacks(const Request& request, const LastPlan* last);
  void place_final_slacks(const WayAhead& way);
  double inside(double room, double weight) const;

  const Settings settings_;
  const vehicle::Parameters vehicle_;
  const world::Goal goal_;
  const std::shared_ptr<const world::Road> road_;
  const std::optional<double> offset_;         ///< of the goal on the road [m]
  const std::optional<SpeedProfile> profile_;  ///< of the road
  ocp::Trajectory guess_;
};

}  // namespace slalom::planner
