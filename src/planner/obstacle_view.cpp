#include "obstacle_view.hpp"

#include <algorithm>
#include <cmath>
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

/// An ellipse larger all around by a disc: that of the sums of semi-axes for a circle, else the
/// smallest of the outer ellipses of the sum of two (A. Kurzhanski and I. Valyi, "Ellipsoidal
/// calculus for estimation and control", 1997, section 2.3) by the sum of their squares.
Obstacle larger(Obstacle o, double radius) {
  if (o.a == o.b || radius == 0) return o.grown(radius);
  const double share = std::hypot(o.a, o.b) / (std::sqrt(2.) * radius);
  const auto sum = [&](double axis) {
    return std::sqrt((1 + 1 / share) * axis * axis + (1 + share) * radius * radius);
  };
  o.a = sum(o.a);
  o.b = sum(o.b);
  return o;
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

std::vector<double> Pair::numbers(double t, double around) const {
  constexpr double away = 1e5, size = 1e3;
  const Obstacle& o = obstacle;
  if (!o.present(t - around, t + around)) return {away, away, size, size, 0, 0};
  const double margin = o.margin(t), a = o.a + margin, b = o.b + margin;
  if (!o.trajectory) return {o.x, o.y, a, b, o.vx, o.vy};
  const world::Pose at = o.pose_at(t);
  return {at.x - at.vx * t, at.y - at.vy * t, a, b, at.vx, at.vy};
}

std::vector<Obstacle> covered(const Settings& settings, const std::vector<Obstacle>& obstacles) {
  std::vector<Obstacle> discs;
  for (const auto& o : obstacles)
    for (auto& disc : world::covering_discs(o, settings.cover_excess))
      discs.push_back(std::move(disc));
  return discs;
}

std::vector<Pair> pairs_of(const std::vector<Obstacle>& discs,
                           const std::vector<world::Disc>& vehicle) {
  std::vector<Pair> pairs;
  for (const auto& o : discs)
    for (const auto& disc : vehicle) pairs.push_back({larger(o, disc.radius), disc.ahead});
  return pairs;
}

}  // namespace slalom::planner
