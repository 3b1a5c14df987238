#include "road_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slalom::planner {
namespace {

using namespace vehicle;
using world::GoalKind;
using world::OnRoad;
using world::Point;

/// A plan ends so far beyond a line across the road [m], and lasts so long at the least [s]: the
/// vehicle drives over the line and does not stop at it.
constexpr double kBeyondLine = 1, kLeastTime = 0.5;
/// What has no end lies so many ranges ahead.
constexpr double kFarRanges = 2;

/// How far a plan that comes to the goal goes at the least: as far as it must in the shortest
/// horizon, and over a line.
double least_way(const Task& task, const Request& request) {
  const double least = task.goal.is_place() ? task.planner.tf_min
                                            : std::max(request.t_start - request.t0, kLeastTime);
  return std::max(request.X0p[UX], 0.) * least;
}

}  // namespace

double goal_ahead(const Task& task, double s) {
  const world::Goal& goal = task.goal;
  const world::Road& road = *task.road;
  if (goal.kind() == GoalKind::line) return road.unwrapped(goal.s, s) - s;
  if (goal.is_place()) {
    const double ahead = road.unwrapped(road.project({goal.x, goal.y}).s, s) - s;
    // What lies behind on a closed road lies ahead of the rest of it, but where one is there.
    const double there =
        goal.kind() == GoalKind::square ? goal.sigma : std::hypot(goal.length, goal.width) / 2;
    return road.closed() && ahead < -there ? ahead + road.length() : ahead;
  }
  const double left = road.closed() ? 0 : road.length() - s;
  return std::max(left, kFarRanges * task.planner.L_range);
}

std::optional<double> goal_offset(const Task& task) {
  if (!task.goal.is_place()) return std::nullopt;
  return task.road->project({task.goal.x, task.goal.y}).n;
}

WayAhead way_ahead(const Task& task, const Request& request, std::optional<double> hint) {
  const Point here{request.X0p[X], request.X0p[Y]};
  const OnRoad on = hint ? task.road->project(here, *hint) : task.road->project(here);
  WayAhead way{on.s, on.n, goal_ahead(task, on.s), 0, false};
  const auto kind = task.goal.kind();
  const double across = on.n - goal_offset(task).value_or(on.n);
  // What lies behind is passed, and the road goes on.
  const bool behind = task.goal.is_place() && way.ahead < -task.planner.XF_tol;
  way.in_range = kind != GoalKind::time && kind != GoalKind::laps && !behind &&
                 std::hypot(way.ahead, across) < task.planner.L_range;
  const double wanted = way.ahead + (kind == GoalKind::line ? kBeyondLine : 0);
  way.aim = way.s + (way.in_range ? std::max(wanted, least_way(task, request)) : wanted);
  return way;
}

std::vector<double> follow(const world::Road& road, double s, const std::vector<Point>& places) {
  std::vector<double> along;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double hint = k == 0 ? s : s + (places[k] - places[k - 1]).norm();
    s = road.unwrapped(road.project(places[k], hint).s, hint);
    along.push_back(s);
  }
  return along;
}

}  // namespace slalom::planner
