#include "arrival_end.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace slalom::planner {
namespace {

using namespace vehicle;
using ocp::Bounds;
using ocp::Expr;

/// Where the end may lie, in half-widths of the goal's place from its middle.
constexpr double kEnd = 0.6;
/// Beyond a line across the road [m].
constexpr double kBeyondLine = 0.2, kLineDepth = 5;
/// Of the ranges of what else is asked, or so much inside them where they are wide [their unit].
constexpr double kShare = 0.25, kInside = 0.1;

/// A way that ends on the road is turned no farther from its direction [rad], and turns no faster
/// beside it [rad/s]: it goes on.
constexpr double kEndHeading = 0.15, kEndTurn = 0.1;

}  // namespace

Bounds inside_range(double lower, double upper) {
  const double by = std::min(kInside, kShare * (upper - lower));
  return {lower + by, upper - by};
}

ArrivalEnd::ArrivalEnd(ocp::Problem& problem, const Task& task, const States& states,
                       const Expr& t_start)
    : goal_(task.goal), road_(task.road) {
  add_place(problem, states);
  add_conditions(problem, states, t_start);
  if (road_ && !goal_.is_place()) add_going_on(problem, states);
  if (goal_.kind() != world::GoalKind::time) return;
  duration_ = problem.parameter("duration", 1);
  problem.boundary("time is up", problem.final_time() - *duration_, Bounds::equal(0));
  ahead_ = {problem.parameter("ahead_x", 1), problem.parameter("ahead_y", 0)};
  problem.mayer("progress", -task.planner.w_t / kProgressSpeed *
                                (ahead_[0] * (problem.final(states[X]) - goal_.x) +
                                 ahead_[1] * (problem.final(states[Y]) - goal_.y)));
}

void ArrivalEnd::add_place(ocp::Problem& problem, const States& states) const {
  const Expr dx = problem.final(states[X]) - goal_.x, dy = problem.final(states[Y]) - goal_.y;
  const double c = std::cos(goal_.psi), s = std::sin(goal_.psi);
  const auto within = [](double half) { return Bounds{-kEnd * half, kEnd * half}; };
  switch (goal_.kind()) {
    case world::GoalKind::square:
      problem.boundary("goal x", dx, within(goal_.sigma));
      problem.boundary("goal y", dy, within(goal_.sigma));
      break;
    case world::GoalKind::rectangle:
      problem.boundary("along goal", c * dx + s * dy, within(goal_.length / 2));
      problem.boundary("across goal", c * dy - s * dx, within(goal_.width / 2));
      break;
    case world::GoalKind::line:
      problem.boundary("beyond line", c * dx + s * dy, {kBeyondLine, kBeyondLine + kLineDepth});
      break;
    case world::GoalKind::time:
    case world::GoalKind::laps:
      break;
  }
}

void ArrivalEnd::add_conditions(ocp::Problem& problem, const States& states, const Expr& t_start) {
  if (goal_.psi_tolerance < world::Goal::kAbsent) {
    turns_ = problem.parameter("goal_psi", goal_.psi);
    problem.boundary("goal heading", problem.final(states[PSI]) - *turns_,
                     inside_range(-goal_.psi_tolerance, goal_.psi_tolerance));
  }
  const Bounds ux = inside_range(goal_.ux_min, goal_.ux_max),
               t = inside_range(goal_.t_min, goal_.t_max);
  if (ux.bounded()) problem.boundary("goal speed", problem.final(states[UX]), ux);
  if (t.bounded()) problem.boundary("goal time", t_start + problem.final_time(), t);
}

void ArrivalEnd::add_going_on(ocp::Problem& problem, const States& states) {
  end_psi_ = problem.parameter("end_psi", 0);
  end_bend_ = problem.parameter("end_bend", 0);
  problem.boundary("end heading", problem.final(states[PSI]) - *end_psi_,
                   {-kEndHeading, kEndHeading});
  problem.boundary("end turn", problem.final(states[R]) - *end_bend_ * problem.final(states[UX]),
                   {-kEndTurn, kEndTurn});
}

double ArrivalEnd::duration(const Motion& guess) const {
  return (duration_ ? goal_.time : guess.end()) - guess.begin();
}

void ArrivalEnd::set(ocp::Problem& problem, const Motion& guess) const {
  const State end = duration_ ? guess.state_at(goal_.time) : guess.states.back();
  // Of the same turn as the guess.
  const auto near = [&](double psi) {
    constexpr double turn = 2 * std::numbers::pi;
    return psi + turn * std::round((end[PSI] - psi) / turn);
  };
  if (turns_) problem.set_parameter(*turns_, near(goal_.psi));
  if (!end_psi_) return;
  const auto at = road_->at(road_->project({end[X], end[Y]}).s);
  problem.set_parameter(*end_psi_, near(at.psi));
  problem.set_parameter(*end_bend_, at.curvature);
  if (!duration_) return;
  problem.set_parameter(*duration_, duration(guess));
  problem.set_parameter(ahead_[0], std::cos(at.psi));
  problem.set_parameter(ahead_[1], std::sin(at.psi));
}

}  // namespace slalom::planner
