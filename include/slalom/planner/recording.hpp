#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "slalom/base/kernels.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/planner/plan.hpp"
#include "slalom/planner/task.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::planner {

/// All data that one solve of a planner depends on, except the planner's own settings, and how it
/// ended: enough to solve it again to the same bits. Positions and headings are in the planner's
/// own frame, which may differ from the task's (docs/design.md, "Frames").
struct Recording {
  vehicle::State X0p{};  ///< of the Request
  double t0 = 0, t_start = 0.5;
  bool goal_in_range = false;  ///< which form of the OCP
  KernelSet kernels = KernelSet::baseline;
  nlp::Options options;  ///< without callbacks
  nlp::Start start;

  nlp::Status status = nlp::Status::numerical_failure;
  int iterations = 0;
  double phi = 0;                                         ///< of nlp::check at `end`
  double cpu_s = 0, wall_s = 0;                           ///< of the solve
  nlp::Start end;                                         ///< the answer's point
  std::optional<std::vector<world::Obstacle>> obstacles;  ///< of the Request
  /// Where along its road a planner that follows one has the vehicle [m].
  std::optional<double> s;
};

/// A plan of a verifying planner, with all data that its certificate depends on, except vehicle,
/// goal and region: enough to verify it again to the same bits.
struct RecordedPlan {
  Rung rung = Rung::none;
  double t0 = 0;   ///< of the Request
  double tex = 0;  ///< time between the loop's checks of arrival [s]
  // What the plan must keep: distance from obstacles' edges and from the road's (`edge`) [m], wheel
  // loads [N], and a disk to stay in, outside which anything may stand [m].
  double clearance = 0, wheel_load = 0;
  double seen_x = 0, seen_y = 0, seen_radius = std::numeric_limits<double>::infinity();
  std::vector<world::Obstacle> obstacles;  ///< as believed
  std::vector<double> t;                   ///< absolute [s]
  std::vector<vehicle::State> states;
  std::vector<vehicle::Control> controls;
  Certificate certificate;
  double edge = 0;
};

/// Which solves or plans a planner records, and what receives them.
struct Recorder {
  std::function<bool(const SolveReport&)> wanted;
  std::function<void(const Recording&)> take;
  std::function<void(const RecordedPlan&)> take_plan;
};

/// The result of solving a recorded solve again.
struct Replayed {
  nlp::Status status = nlp::Status::numerical_failure;
  int iterations = 0;
  double phi = 0;
  bool same = false;  ///< point, iterations and status are the same, to the last bit
};

/// Solves a recording again with its kernel set, which stays selected. A solve that time or the
/// user cut off ends at the same iteration instead. Throws Error for a kernel set that the
/// processor lacks, InvalidValue for a start that does not fit this problem and for a request that
/// check() refuses.
Replayed replay(const Recording& recording, const Task& task);

/// Throws InvalidValue, which says `where`, for what no planner records: no motion, numbers that
/// are not finite, times out of order or far apart, and more looks for arrival than a drive has.
void check(const RecordedPlan& recording, const std::string& where);
/// Drives the believed plant by a recorded plan again, and returns the new certificate. Throws
/// InvalidValue for what check() refuses.
Certificate verify_again(const RecordedPlan& recording, const Task& task);
/// Whether two certificates are the same, to the last bit.
bool same(const Certificate& one, const Certificate& other);

}  // namespace slalom::planner
