#pragma once

#include <functional>
#include <vector>

#include "slalom/base/kernels.hpp"
#include "slalom/nlp/solver.hpp"
#include "slalom/planner/plan.hpp"
#include "slalom/planner/task.hpp"
#include "slalom/vehicle/state.hpp"
#include "slalom/world/obstacle.hpp"

namespace slalom::planner {

/// All that one solve of a planner depends on beside the planner's own settings, and how it ended:
/// enough to solve it again to the same bits.
struct Recording {
  vehicle::State X0p{};  ///< of the Request
  double t0 = 0, t_start = 0.5;
  bool goal_in_range = false;  ///< which form of the OCP
  KernelSet kernels = KernelSet::baseline;
  nlp::Options options;  ///< without callbacks
  nlp::Start start;

  nlp::Status status = nlp::Status::numerical_failure;
  int iterations = 0;
  double phi = 0;                          ///< of nlp::check at `end`
  double cpu_s = 0, wall_s = 0;            ///< of the solve
  nlp::Start end;                          ///< the answer's point
  std::vector<world::Obstacle> obstacles;  ///< of the Request
};

/// Which solves a planner records, and where to.
struct Recorder {
  std::function<bool(const SolveReport&)> wanted;
  std::function<void(const Recording&)> take;
};

/// A recorded solve, solved again.
struct Replayed {
  nlp::Status status = nlp::Status::numerical_failure;
  int iterations = 0;
  double phi = 0;
  bool same = false;  ///< the answer's point, iterations and status, to the last bit
};

/// Solves a recording again with the kernel set it names, which stays selected. A solve that was
/// cut off by time or by the user ends at the same iteration instead. Throws Error for a kernel set
/// that the processor lacks, InvalidValue for a start that is none of this problem.
Replayed replay(const Recording& recording, const Task& task);

}  // namespace slalom::planner
