#include "obstacle_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "obstacle_view.hpp"

namespace slalom::planner {
namespace {

using vehicle::State;

/// Distance [m] from an ellipse's centre to its edge in the direction of (dx, dy).
double radius_towards(const world::Obstacle& o, double dx, double dy) {
  const double length = std::hypot(dx, dy);
  if (length == 0) return std::min(o.a, o.b);
  return length / std::hypot(dx / o.a, dy / o.b);
}

/// Between the edges of two obstacles along the line of their centres [m]; negative: they overlap.
double gap(const world::Obstacle& p, const world::Obstacle& q) {
  const double dx = q.x - p.x, dy = q.y - p.y;
  return std::hypot(dx, dy) - radius_towards(p, dx, dy) - radius_towards(q, dx, dy);
}

/// How much an ellipse about `o`'s centre with semi-axes a, b must be scaled to cover `member`: the
/// largest value over the member's edge of the ellipse's norm. The edge is sampled, and the norm,
/// whose slope along it is at most that of its two terms, bounded between samples.
double scale_to_cover(const world::Obstacle& o, const world::Obstacle& member) {
  constexpr int kSamples = 720;
  const double step = 2 * std::numbers::pi / kSamples;
  const double steepest = std::hypot(member.a / o.a, member.b / o.b);
  double most = 0;
  for (int k = 0; k < kSamples; ++k) {
    const double x = member.x - o.x + member.a * std::cos(k * step);
    const double y = member.y - o.y + member.b * std::sin(k * step);
    most = std::max(most, std::hypot(x / o.a, y / o.b));
  }
  return most + steepest * step / 2;
}

/// The least distance [m] between the obstacle's centre and a point over absolute times t0 to t1;
/// of a trajectory a lower bound, by places so close that it is 1 m too small at the most.
double nearest_pass(const world::Obstacle& o, double x, double y, double t0, double t1) {
  if (o.trajectory) {
    double least = INFINITY;
    const double rate = o.trajectory->fastest(t0, t1).speed;
    const double parts = std::clamp(std::ceil(rate * (t1 - t0) / 2), 1., 1000.);
    const double step = (t1 - t0) / parts;
    for (double k = 0; k <= parts; ++k)
      if (const double t = t0 + k * step; o.present(t - step, t + step))
        least = std::min(least, std::hypot(o.x_at(t) - x, o.y_at(t) - y));
    return least - rate * step / 2;
  }
  const double dx = o.x_at(t0) - x, dy = o.y_at(t0) - y;
  const double speed2 = o.vx * o.vx + o.vy * o.vy;
  const double t = speed2 > 0 ? std::clamp(-(dx * o.vx + dy * o.vy) / speed2, 0.0, t1 - t0) : 0.0;
  return std::hypot(dx + o.vx * t, dy + o.vy * t);
}

/// How far from X0p a plan may come [m]: every node lies within L_range + kappa of x(0), and x(0)
/// within X0_tol of X0p.
double reach_of(const Settings& s) {
  return s.L_range + s.kappa + std::hypot(s.X0_tol[0], s.X0_tol[1]);
}

/// How far from X0p the centre of an obstacle is that a plan can touch [m].
double reach_of(const Settings& s, const Request& request, const world::Obstacle& o) {
  return reach_of(s) + std::max(o.a, o.b) + s.sm_end + o.margin(request.t_start + s.tf_max);
}

/// The least distance [m] between an obstacle's centre and X0p over the times of a plan.
double nearest_pass(const Settings& s, const Request& request, const world::Obstacle& o) {
  const double begin = s.moving_avoidance ? request.t_start : request.t0;
  const double end = s.moving_avoidance ? begin + s.tf_max : begin;
  return nearest_pass(o, request.X0p[vehicle::X], request.X0p[vehicle::Y], begin, end);
}

/// An obstacle that stays farther than the first beyond a plan's reach is a far one, and is put as
/// far beyond it as the second [m].
constexpr double kFar = 2048, kParked = 50;

bool far(const Settings& s, const Request& request, const world::Obstacle& o) {
  return nearest_pass(s, request, o) > reach_of(s, request, o) + kFar;
}

/// A far obstacle, standing where its row is of the others' size and no plan comes.
world::Obstacle parked(const Settings& s, const Request& request, const world::Obstacle& o) {
  const double x = request.X0p[vehicle::X], y = request.X0p[vehicle::Y];
  const double dx = o.x_at(request.t_start) - x, dy = o.y_at(request.t_start) - y;
  const double share = (reach_of(s, request, o) + kParked) / std::hypot(dx, dy);
  world::Obstacle result = o;
  result.x = x + share * dx;
  result.y = y + share * dy;
  result.vx = result.vy = 0;
  result.trajectory = nullptr;
  return result;
}

std::vector<world::Obstacle> in_reach(const Settings& s, const Request& request,
                                      const std::vector<world::Obstacle>& obstacles, double body) {
  std::vector<world::Obstacle> chosen;
  for (const auto& o : obstacles)
    if (nearest_pass(s, request, o) <= reach_of(s, request, o) + body) chosen.push_back(o);
  return chosen;
}

std::vector<world::Obstacle> nearest(const Settings& s, const Request& request,
                                     const std::vector<world::Obstacle>& obstacles) {
  const double t = s.moving_avoidance ? request.t_start : request.t0;
  std::vector<double> distance;
  for (const auto& o : obstacles) {
    if (!o.is_plain()) {
      distance.push_back(
          o.present(t, t) ? world::distance(o, request.X0p[vehicle::X], request.X0p[vehicle::Y], t)
                          : INFINITY);
      continue;
    }
    const double dx = o.x_at(t) - request.X0p[vehicle::X], dy = o.y_at(t) - request.X0p[vehicle::Y];
    distance.push_back(std::hypot(dx, dy) - radius_towards(o, dx, dy));
  }
  std::vector<std::size_t> order(obstacles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return distance[i] < distance[j]; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(s.obstacle_count)));
  std::sort(order.begin(), order.end());
  std::vector<world::Obstacle> chosen;
  for (const auto i : order) chosen.push_back(obstacles[i]);
  return chosen;
}

}  // namespace

world::Obstacle covering_ellipse(const std::vector<world::Obstacle>& members) {
  if (members.size() == 1) return members.front();
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
  for (const auto& o : members) {
    west = std::min(west, o.x - o.a);
    east = std::max(east, o.x + o.a);
    south = std::min(south, o.y - o.b);
    north = std::max(north, o.y + o.b);
  }
  world::Obstacle cover = members.front();
  cover.name = members.front().name + "+" + std::to_string(members.size() - 1);
  cover.x = (west + east) / 2;
  cover.y = (south + north) / 2;
  cover.a = (east - west) / 2;
  cover.b = (north - south) / 2;
  double scale = 0;
  for (const auto& o : members) scale = std::max(scale, scale_to_cover(cover, o));
  scale = std::min(scale, std::numbers::sqrt2);  // the ellipse through the box's corners
  cover.a *= scale;
  cover.b *= scale;
  return cover;
}

namespace {

/// One ellipse has one velocity and one margin.
bool alike(const world::Obstacle& p, const world::Obstacle& q) {
  return p.is_plain() && q.is_plain() && p.vx == q.vx && p.vy == q.vy &&
         p.margin_start == q.margin_start && p.margin_rate == q.margin_rate &&
         p.predicted_at == q.predicted_at;
}

}  // namespace

std::vector<world::Obstacle> group_obstacles(const Settings& settings,
                                             const std::vector<world::Obstacle>& obstacles) {
  if (settings.obstacle_group_gap == 0) return obstacles;
  const std::size_t n = obstacles.size();
  std::vector<std::size_t> group(n);
  std::iota(group.begin(), group.end(), std::size_t{0});
  // The first member names a group; a link renames the later of two groups.
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const auto &p = obstacles[i], &q = obstacles[j];
      if (!alike(p, q) || gap(p, q) >= settings.obstacle_group_gap) continue;
      const auto keep = std::min(group[i], group[j]), drop = std::max(group[i], group[j]);
      std::replace(group.begin(), group.end(), drop, keep);
    }
  std::vector<world::Obstacle> result;
  for (std::size_t first = 0; first < n; ++first) {
    std::vector<world::Obstacle> members;
    for (std::size_t i = first; i < n; ++i)
      if (group[i] == first) members.push_back(obstacles[i]);
    if (!members.empty()) result.push_back(covering_ellipse(members));
  }
  return result;
}

std::vector<world::Obstacle> choose_obstacles(const Settings& settings, const Request& request,
                                              const std::vector<world::Obstacle>& obstacles,
                                              const world::Footprint& footprint) {
  if (settings.obstacle_choice == ObstacleChoice::in_reach)
    return in_reach(settings, request, stand_ins(settings, footprint, obstacles),
                    footprint.reach());
  auto chosen = stand_ins(settings, footprint,
                          settings.obstacle_choice == ObstacleChoice::nearest
                              ? nearest(settings, request, obstacles)
                              : obstacles);
  for (auto& o : chosen)
    if (far(settings, request, o)) o = parked(settings, request, o);
  return chosen;
}

bool any_far(const Settings& settings, const Request& request,
             const std::vector<world::Obstacle>& obstacles) {
  return std::any_of(obstacles.begin(), obstacles.end(),
                     [&](const auto& o) { return far(settings, request, o); });
}

bool same_names(const std::vector<world::Obstacle>& a, const std::vector<world::Obstacle>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const world::Obstacle& p, const world::Obstacle& q) { return p.name == q.name; });
}

}  // namespace slalom::planner
