#pragma once

#include <array>
#include <memory>
#include <optional>

#include "motion.hpp"
#include "slalom/ocp/problem.hpp"
#include "slalom/planner/task.hpp"

namespace slalom::planner {

/// The range of what is asked of the vehicle on arrival, a little smaller on each side that is
/// there.
ocp::Bounds inside_range(double lower, double upper);

/// The end of the OCP of a whole way: rows that make its last point reach the goal, and what a goal
/// by time pays for instead, which is progress along the road.
class ArrivalEnd {
 public:
  using States = std::array<ocp::Expr, vehicle::kStates>;
  /// Adds rows and terms to a problem with these states, whose horizon begins at t_start [s].
  ArrivalEnd(ocp::Problem& problem, const Task& task, const States& states,
             const ocp::Expr& t_start);

  /// How long the horizon of a guess is [s]: what is left of the time, where that is the goal.
  double duration(const Motion& guess) const;
  /// Sets what depends on the guess.
  void set(ocp::Problem& problem, const Motion& guess) const;

 private:
  void add_place(ocp::Problem& problem, const States& states) const;
  void add_going_on(ocp::Problem& problem, const States& states);
  void add_conditions(ocp::Problem& problem, const States& states, const ocp::Expr& t_start);

  world::Goal goal_;
  std::shared_ptr<const world::Road> road_;
  std::optional<ocp::Expr> duration_, turns_, end_psi_, end_bend_;  ///< parameters
  std::array<ocp::Expr, 2> ahead_;  ///< the road's direction where the guess ends, of a time
};

/// Progress along the road counts as time at this speed [m/s].
constexpr double kProgressSpeed = 15;

}  // namespace slalom::planner
