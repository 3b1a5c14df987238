#include "slalom/world/way_signature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace slalom::world {
namespace {

constexpr double kTurn = 0.75 * std::numbers::pi;  ///< between ways that pass differently [rad]
constexpr double kOrder = 1;                       ///< between two passings in an order [s]

Passing passing(const Way& way, const Obstacle& o) {
  Passing result;
  result.nearest = std::numeric_limits<double>::infinity();
  double x0 = 0, y0 = 0;
  bool there = false;
  for (const auto& p : way) {
    if (!o.present(p.t, p.t)) {
      there = false;
      continue;
    }
    const double x = o.x_at(p.t) - p.x, y = o.y_at(p.t) - p.y, distance = std::hypot(x, y);
    if (distance < result.nearest) {
      result.nearest = distance;
      result.when = p.t;
    }
    if (std::exchange(there, true)) result.swept += std::atan2(x0 * y - y0 * x, x0 * x + y0 * y);
    x0 = x;
    y0 = y;
  }
  return result;
}

}  // namespace

WaySignature signature(const Way& way, const std::vector<Obstacle>& obstacles) {
  WaySignature result;
  if (way.empty()) return result;
  result.reserve(obstacles.size());
  for (const auto& o : obstacles) result.push_back(passing(way, o));
  return result;
}

bool differ(const WaySignature& one, const WaySignature& other, double reach) {
  const auto near = [&](std::size_t i) {
    return std::min(one[i].nearest, other[i].nearest) <= reach;
  };
  const auto count = std::min(one.size(), other.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (!near(i)) continue;
    if (std::fabs(one[i].swept - other[i].swept) > kTurn) return true;
    for (std::size_t j = 0; j < i; ++j) {
      const double first = one[i].when - one[j].when, second = other[i].when - other[j].when;
      if (near(j) && std::min(std::fabs(first), std::fabs(second)) > kOrder && first * second < 0)
        return true;
    }
  }
  return false;
}

}  // namespace slalom::world
