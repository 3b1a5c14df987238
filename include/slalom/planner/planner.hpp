#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "slalom/planner/plan.hpp"
#include "slalom/planner/recording.hpp"
#include "slalom/planner/task.hpp"

namespace slalom::planner {

/// What one planning cycle knows.
struct Request {
  vehicle::State X0p{};  ///< predicted state at t_start
  double t0 = 0;         ///< absolute time of planning [s]
  double t_start = 0.5;  ///< absolute time at which the plan begins: t0 + tex [s]
  double time_limit = std::numeric_limits<double>::infinity();  ///< thread time of planning [s]
  /// By the wall clock [s]: the plan is of no use later. For planners that verify.
  double clock_limit = std::numeric_limits<double>::infinity();
  /// The last plan was there too late, and is not driven: the one before it goes on. For planners
  /// that verify.
  bool last_was_late = false;
  /// Nothing is driven while it plans, so that a planner that shares its time out over cycles need
  /// not.
  bool warm_up = false;
  /// A plan that is not solved, but violates no row or bound by more than this [its unit], is one
  /// to be driven, and the next solve starts from it. Negative: none is.
  double best_iterate_tol = -1;
  /// As measured in this cycle, as many as there are, their positions those at t = 0; those of one
  /// name are one from cycle to cycle. Nothing: as the planner was made with.
  std::optional<std::vector<world::Obstacle>> obstacles;
  std::function<bool()> interrupted;  ///< polled during the solve; true stops it, not solved
};

class LocalFrame;
class PlanningMethod;

/// Plans one trajectory in each cycle, by the method of its settings. The paper's solves the OCP of
/// section 3; the solve starts warm from the last plan that was solved, that was to be driven
/// although unsolved, or whose solve was cut short (by the deadline or an interrupt). Another
/// drives no plan that is not verified, and one drives along a road as fast as it allows
/// (Settings::method). Not thread-safe; use one planner for each thread.
class Planner {
 public:
  explicit Planner(const Task& task);
  ~Planner();
  Planner(Planner&&) noexcept;
  Planner& operator=(Planner&&) noexcept;

  /// Solves; a plan whose report says it is not solved is returned too, with the best iterate.
  Plan plan(const Request& request);
  /// Forgets the last plan, so that the next one starts from the straight-on guess.
  void reset();
  /// From now on hands solves that are wanted to the recorder; replay() comes to the same bits, for
  /// a solve depends on nothing that solves before it left behind but its start.
  void record(const Recorder& recorder);

 private:
  std::unique_ptr<LocalFrame> frame_;
  std::unique_ptr<PlanningMethod> method_;
  bool goes_on_;  ///< the method compares a plan's states with the next request's
  bool begun_ = false;
};

}  // namespace slalom::planner
