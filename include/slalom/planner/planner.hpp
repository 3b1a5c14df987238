#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "slalom/planner/goal.hpp"
#include "slalom/planner/obstacle.hpp"
#include "slalom/planner/plan.hpp"
#include "slalom/planner/recording.hpp"
#include "slalom/planner/settings.hpp"
#include "slalom/vehicle/parameters.hpp"

namespace slalom::planner {

/// What one planning cycle knows.
struct Request {
  vehicle::State X0p{};                                         ///< predicted state at t0 + tex
  double t0 = 0;                                                ///< absolute time of planning [s]
  double tex = 0.5;                                             ///< execution horizon [s]
  double time_limit = std::numeric_limits<double>::infinity();  ///< thread time of planning [s]
  /// A plan that is not solved, but violates no row or bound by more than this [its unit], is one
  /// to be driven, and the next solve starts from it. Negative: none is.
  double best_iterate_tol = -1;
  /// As measured in this cycle, in the order and with the names that the planner was made with;
  /// empty: as it was made.
  std::vector<Obstacle> obstacles;
  std::function<bool()> interrupted;  ///< polled during the solve; true stops it, not solved
};

/// Plans one trajectory in each cycle by solving the OCP of section 3. The solve starts warm from
/// the last plan that was solved, that was to be driven although unsolved, or whose solve was
/// cut short (by the deadline or an interrupt). Not thread-safe; use one planner for each thread.
class Planner {
 public:
  Planner(const Settings& settings, const vehicle::Parameters& vehicle, const Goal& goal,
          const Region& region, const std::vector<Obstacle>& obstacles);
  ~Planner();
  Planner(Planner&&) noexcept;
  Planner& operator=(Planner&&) noexcept;

  /// Solves; a plan whose report says it is not solved is returned too, with the best iterate.
  Plan plan(const Request& request);
  /// Forgets the last plan, so that the next one starts from the straight-on guess.
  void reset();
  /// From now on hands solves that are wanted to the recorder; replay() comes to the same bits, for
  /// a solve depends on nothing that solves before it left behind but its start.
  void record(Recorder recorder);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::planner
