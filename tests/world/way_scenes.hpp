#pragma once

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "slalom/world/way_finder.hpp"

namespace slalom::world {

inline constexpr double kPi = std::numbers::pi;

/// Drives into a goal some way ahead, at 17 m/s. Where the region ends is not said.
struct World {
  Environment environment;
  vehicle::State start{};
  vehicle::Parameters vehicle;
  double t_start = 0;

  WayFinder finder() const { return {environment, vehicle}; }
  std::optional<Way> find(const WaySearch& search = {}) const {
    auto f = finder();
    return f.find(start, t_start, environment.obstacles, search);
  }
};

inline vehicle::State state(double x, double y, double psi, double ux) {
  vehicle::State result{};
  result[vehicle::X] = x;
  result[vehicle::Y] = y;
  result[vehicle::PSI] = psi;
  result[vehicle::UX] = ux;
  return result;
}

inline World northwards(double length = 150) {
  World w;
  w.start = state(0, 0, kPi / 2, 17);
  w.environment.goal = {0, length, kPi / 2, 15};
  return w;
}

/// The least distance from the obstacles that the way keeps [m].
inline double clearance(const Way& way, const std::vector<Obstacle>& obstacles) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < way.size(); ++k)
    for (int part = 0; part < 5; ++part) {
      const auto &p = way[k - 1], &q = way[k];
      const double s = part / 5.0;
      for (const auto& o : obstacles)
        least = std::min(least, distance(o, p.x + s * (q.x - p.x), p.y + s * (q.y - p.y),
                                         p.t + s * (q.t - p.t)));
    }
  return least;
}

}  // namespace slalom::world
