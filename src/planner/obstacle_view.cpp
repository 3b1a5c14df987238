#include "obstacle_view.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "obstacle_rows.hpp"

namespace slalom::planner {
namespace {

using world::Obstacle;

/// More rows than these are not worth their time.
constexpr int kMostParts = 6;

/// Into how many a rectangle is cut: parts about half as long as wide.
int parts_of(const Obstacle& rectangle) {
  const HalfSides half = half_sides(rectangle);
  const double longer = std::max(half.length, half.width),
               shorter = std::min(half.length, half.width);
  return std::clamp(static_cast<int>(std::lround(2 * longer / shorter)), 1, kMostParts);
}

}  // namespace

bool varies(const Obstacle& obstacle) {
  return obstacle.trajectory || obstacle.margin_rate > 0;
}

std::vector<Obstacle> stand_ins(const Settings& settings, const world::Footprint& footprint,
                                const std::vector<Obstacle>& obstacles) {
  std::vector<Obstacle> result;
  for (const auto& o : obstacles) {
    const bool round = !o.outline && (o.a == o.b || (o.is_plain() && footprint.is_point()));
    if (round || (footprint.is_point() && !o.outline)) {
      result.push_back(o);
      continue;
    }
    auto whole = world::covering_rectangles(o);
    auto discs = world::covering_discs(whole.front(), settings.cover_excess);
    if (discs.size() > 1)
      discs = footprint.is_point() ? world::covering_rectangles(o, parts_of(whole.front()))
                                   : std::move(whole);
    std::move(discs.begin(), discs.end(), std::back_inserter(result));
  }
  return result;
}

bool same(const std::vector<world::Obstacle>& a, const std::vector<world::Obstacle>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return p.x == q.x && p.y == q.y && p.a == q.a && p.b == q.b && p.vx == q.vx && p.vy == q.vy &&
           p.psi == q.psi && p.rounding == q.rounding && p.outline == q.outline &&
           p.trajectory == q.trajectory && p.margin_start == q.margin_start &&
           p.margin_rate == q.margin_rate;
  });
}

}  // namespace slalom::planner
