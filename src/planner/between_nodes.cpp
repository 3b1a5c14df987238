#include "between_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace slalom::planner {
namespace {

using namespace vehicle;

struct Vector {
  double x = 0, y = 0;

  Vector operator+(Vector o) const { return {x + o.x, y + o.y}; }
  Vector operator-(Vector o) const { return {x - o.x, y - o.y}; }
  Vector operator*(double s) const { return {x * s, y * s}; }
  double norm() const { return std::hypot(x, y); }
};

/// Of the front axle's centre (paper, Eqn. 1; docs/formulation.md, section 2).
Vector velocity(const State& s, double la) {
  const double front = s[V] + la * s[R];
  return {s[UX] * std::cos(s[PSI]) - front * std::sin(s[PSI]),
          s[UX] * std::sin(s[PSI]) + front * std::cos(s[PSI])};
}

/// Between two nodes: the cubic with their places and velocities.
struct Interval {
  double t0 = 0, length = 0;  ///< absolute time of the first [s]
  Vector p0, p1, v0, v1;

  Vector place(double share) const {
    const double s = share, h00 = (1 + 2 * s) * (1 - s) * (1 - s), h10 = s * (1 - s) * (1 - s);
    const double h01 = s * s * (3 - 2 * s), h11 = s * s * (s - 1);
    return p0 * h00 + p1 * h01 + (v0 * h10 + v1 * h11) * length;
  }
  /// The derivative's Bernstein coefficients bound it.
  double fastest() const {
    const Vector middle = (p1 - p0) * (3 / length) - v0 - v1;
    return std::max({v0.norm(), middle.norm(), v1.norm()});
  }
};

/// Looks for where an interval is deepest within an obstacle's margin.
class Search {
 public:
  Search(const Interval& interval, const world::Obstacle& obstacle, double held, double margin,
         Passage& deepest)
      : interval_(interval), obstacle_(obstacle), held_(held), margin_(margin), deepest_(deepest) {
    const double moving = held < 0 ? std::hypot(obstacle.vx, obstacle.vy) : 0;
    rate_ = (interval.fastest() + moving) * interval.length;
  }

  void run() {
    // Far ones, which are most, are told by the distance between centres.
    const Vector o{obstacle_.x_at(time(0)), obstacle_.y_at(time(0))};
    const double most = std::max(obstacle_.a, obstacle_.b) + margin_ - deepest_.depth;
    if ((interval_.p0 - o).norm() > most + rate_) return;
    split(0, depth(0), 1, depth(1));
  }

 private:
  double time(double share) const {
    return held_ >= 0 ? held_ : interval_.t0 + share * interval_.length;
  }
  double depth(double share) {
    const Vector p = interval_.place(share);
    const double d = margin_ - world::distance(obstacle_, p.x, p.y, time(share));
    if (d > deepest_.depth + kPassageResolution / 2)
      deepest_ = {d, obstacle_.name, interval_.t0 + share * interval_.length};
    return d;
  }
  /// Between two moments depth rises above the mean of theirs by half of what it can change by.
  void split(double s0, double d0, double s1, double d1) {
    const double change = rate_ * (s1 - s0);
    if ((d0 + d1 + change) / 2 <= deepest_.depth + kPassageResolution / 2) return;
    if (change < kPassageResolution) return;
    const double middle = (s0 + s1) / 2, d = depth(middle);
    split(s0, d0, middle, d);
    split(middle, d, s1, d1);
  }

  const Interval& interval_;
  const world::Obstacle& obstacle_;
  const double held_, margin_;
  Passage& deepest_;
  double rate_ = 0;  ///< the most that depth changes by along the interval [m]
};

}  // namespace

Passage deepest_passage(const Plan& plan, const std::vector<world::Obstacle>& obstacles,
                        double margin, double la) {
  Passage deepest;
  for (std::size_t k = 0; k + 1 < plan.t.size(); ++k) {
    Interval i;
    i.t0 = plan.t_start + plan.t[k];
    i.length = plan.t[k + 1] - plan.t[k];
    if (!(i.length > 0)) return deepest;
    const State &a = plan.states[k], &b = plan.states[k + 1];
    i.p0 = {a[X], a[Y]};
    i.p1 = {b[X], b[Y]};
    i.v0 = velocity(a, la);
    i.v1 = velocity(b, la);
    for (const auto& o : obstacles) Search(i, o, plan.obstacle_time_held, margin, deepest).run();
  }
  return deepest;
}

}  // namespace slalom::planner
