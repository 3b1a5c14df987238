#include "obstacle_view.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace slalom::planner {
namespace {

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

bool varies(const Obstacle& obstacle) {
  return obstacle.trajectory || obstacle.margin_rate > 0;
}

bool belief_varies(const Settings& settings, const std::vector<Obstacle>& obstacles) {
  return std::any_of(obstacles.begin(), obstacles.end(), [&](const Obstacle& o) {
    return o.margin_rate > 0 || (o.trajectory && settings.prediction != Prediction::known);
  });
}

std::vector<Obstacle> stand_ins(const Settings& settings, const world::Footprint& footprint,
                                const std::vector<Obstacle>& obstacles) {
  std::vector<Obstacle> result;
  for (const auto& o : obstacles) {
    const bool round = !o.outline && (o.a == o.b || (o.is_plain() && footprint.is_point()));
    auto discs = world::covering_discs(
        round || o.outline || footprint.is_point() ? o : world::covering_rectangle(o),
        settings.cover_excess);
    if (discs.size() == 1)
      result.push_back(std::move(discs.front()));
    else
      result.push_back(footprint.is_point() && !o.outline ? o : world::covering_rectangle(o));
  }
  return result;
}

}  // namespace slalom::planner
