#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slalom/planner/plan.hpp"
#include "slalom/planner/recording.hpp"
#include "slalom/planner/task.hpp"

namespace slalom::planner {

/// The input of one planning cycle.
struct Request {
  vehicle::State X0p{};  ///< predicted state at t_start
  double t0 = 0;         ///< absolute time of planning [s]
  double t_start = 0.5;  ///< absolute time at which the plan begins [s]
  /// Execution horizon [s]: cycles, and the loop's looks for arrival, are this far apart from t0
  /// on. 0: as far apart as t0 and t_start.
  double tex = 0;
  double time_limit = std::numeric_limits<double>::infinity();  ///< thread time of planning [s]
  /// Wall-clock limit [s]; a later plan is useless. For verifying planners.
  double clock_limit = std::numeric_limits<double>::infinity();
  /// The last plan was late and is not driven: the plan before it continues. For verifying
  /// planners.
  bool last_was_late = false;
  /// Nothing is driven during this cycle, so a planner need not spread its work over cycles.
  bool warm_up = false;
  /// An unsolved plan is to be driven if it violates no row or bound by more than this [its unit],
  /// and the next solve starts from it. Negative: never.
  double best_iterate_tol = -1;
  /// The obstacles measured in this cycle, any number, with their positions at t = 0. Obstacles
  /// with the same name are the same from cycle to cycle. Empty: the obstacles of the planner's
  /// task.
  std::optional<std::vector<world::Obstacle>> obstacles;
  std::function<bool()> interrupted;  ///< polled during the solve; true stops it, not solved
};

/// Throws InvalidValue, which says `where`, for a request of no cycle: numbers that are not finite
/// (limits of time may be infinite) or of no vehicle, limits below 0, and horizons of more than an
/// hour, at which a planner that drives its plans would work without end.
void check(const Request& request, const std::string& where);

class LocalFrame;
class PlanningMethod;

/// Plans one trajectory in each cycle, by the method of its settings (Settings::method). The
/// paper's method solves the OCP of section 3. Its solve starts warm from the last plan that was
/// solved, that was to be driven although unsolved, or whose solve was cut short (by the deadline
/// or an interrupt). The other methods verify plans before they are driven, or drive along a road
/// as fast as possible. Not thread-safe; use one planner for each thread.
class Planner {
 public:
  explicit Planner(const Task& task);
  ~Planner();
  Planner(Planner&&) noexcept;
  Planner& operator=(Planner&&) noexcept;

  /// Makes a plan. A plan that is not solved is returned too, with the best iterate; see its
  /// report. Throws InvalidValue for what check() refuses.
  Plan plan(const Request& request);
  /// Forgets the last plan, so that the next one starts from the straight-on guess.
  void reset();
  /// From now on passes wanted solves to the recorder. replay() gives the same bits, since a solve
  /// depends on earlier solves only through its start.
  void record(const Recorder& recorder);

 private:
  std::unique_ptr<LocalFrame> frame_;
  std::unique_ptr<PlanningMethod> method_;
  bool goes_on_;  ///< the method compares a plan's states with the next request's
  bool begun_ = false;
};

}  // namespace slalom::planner
