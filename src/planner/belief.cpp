#include "slalom/planner/belief.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "slalom/world/footprint.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;
using world::Obstacle;

void go_straight(Obstacle& o, const world::Pose& at, double t0) {
  o.trajectory = nullptr;
  o.x = at.x - at.vx * t0;
  o.y = at.y - at.vy * t0;
  o.vx = at.vx;
  o.vy = at.vy;
  o.psi = at.psi;
}

}  // namespace

std::vector<Obstacle> believed(const Settings& settings, std::vector<Obstacle> obstacles,
                               double t0) {
  const bool known = settings.prediction == Prediction::known;
  if (!known) std::erase_if(obstacles, [&](const Obstacle& o) { return !o.present(t0, t0); });
  for (auto& o : obstacles) {
    if (o.margin_rate > 0) o.predicted_at = t0;
    if (known || !o.trajectory) continue;
    const world::Pose at = o.pose_at(t0);
    if (settings.prediction == Prediction::constant_velocity)
      go_straight(o, at, t0);
    else
      o.trajectory = std::make_shared<world::TurningTrajectory>(t0, at);
  }
  return obstacles;
}

bool belief_varies(const Settings& settings, const std::vector<Obstacle>& obstacles) {
  return std::any_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& o) {
    return o.margin_rate > 0 || (o.trajectory && settings.prediction != Prediction::known);
  });
}

world::Point planning_place(const Request& request) {
  const State& x = request.X0p;
  const double driven = x[UX] * (request.t_start - request.t0);
  return {x[X] - driven * std::cos(x[PSI]), x[Y] - driven * std::sin(x[PSI])};
}

std::vector<Obstacle> known_obstacles(const Task& task, const Request& request) {
  auto obstacles = believed(task.planner, request.obstacles.value_or(task.obstacles), request.t0);
  if (task.planner.known != Known::range) return obstacles;
  const world::Footprint footprint(task.vehicle);
  const world::Point place = planning_place(request);
  State from = request.X0p;
  from[X] = place.x;
  from[Y] = place.y;
  std::erase_if(obstacles, [&](const Obstacle& o) {
    return !o.present(request.t0, request.t0) ||
           footprint.distance(o, from, request.t0) > task.planner.L_range;
  });
  return obstacles;
}

}  // namespace slalom::planner
