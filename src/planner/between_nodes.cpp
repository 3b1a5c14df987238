#include "between_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace slalom::planner {
namespace {

using namespace vehicle;

using Vector = world::Point;

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
  double psi0 = 0, psi1 = 0, r0 = 0, r1 = 0;  ///< headings [rad] and yaw rates [rad/s]
  double most_speed = 0;                      ///< fastest(), found once for all obstacles [m/s]

  /// Place and heading.
  State at(double share) const {
    const double s = share, h00 = (1 + 2 * s) * (1 - s) * (1 - s), h10 = s * (1 - s) * (1 - s);
    const double h01 = s * s * (3 - 2 * s), h11 = s * s * (s - 1);
    const Vector p = p0 * h00 + p1 * h01 + (v0 * h10 + v1 * h11) * length;
    State state{};
    state[X] = p.x;
    state[Y] = p.y;
    state[PSI] = psi0 * h00 + psi1 * h01 + (r0 * h10 + r1 * h11) * length;
    return state;
  }
  double fastest_turn() const {
    const double middle = (psi1 - psi0) * (3 / length) - r0 - r1;
    return std::max({std::fabs(r0), std::fabs(middle), std::fabs(r1)});
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
  Search(const Interval& interval, const world::Footprint& footprint,
         const world::Obstacle& obstacle, double held, double margin, Passage& deepest)
      : interval_(interval),
        footprint_(footprint),
        obstacle_(obstacle),
        held_(held),
        margin_(margin),
        deepest_(deepest) {
    const double moving = held < 0 ? obstacle.fastest(time(0), time(1)) + obstacle.margin_rate : 0;
    rate_ = (interval.most_speed + moving) * interval.length;
    if (!footprint.is_point())
      rate_ += interval.fastest_turn() * footprint.reach() * interval.length;
  }

  void run() {
    if (!obstacle_.present(time(0), time(1))) return;
    // Far ones, which are most, are told by the distance between centres.
    const world::Pose o = obstacle_.pose_at(time(0));
    const double near = obstacle_.reach() + footprint_.reach() + margin_ +
                        obstacle_.margin(time(0)) - deepest_.depth + rate_;
    const Vector apart = interval_.p0 - Vector{o.x, o.y};
    if (near < 0 || dot(apart, apart) > near * near) return;
    split(0, depth(0), 1, depth(1));
  }

 private:
  double time(double share) const {
    return held_ >= 0 ? held_ : interval_.t0 + share * interval_.length;
  }
  double depth(double share) {
    const double d = margin_ + obstacle_.margin(time(share)) -
                     footprint_.distance(obstacle_, interval_.at(share), time(share));
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
  const world::Footprint& footprint_;
  const world::Obstacle& obstacle_;
  const double held_, margin_;
  Passage& deepest_;
  double rate_ = 0;  ///< the most that depth changes by along the interval [m]
};

}  // namespace

Passage deepest_passage(const Plan& plan, const std::vector<world::Obstacle>& obstacles,
                        double margin, const world::Footprint& footprint, double la) {
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
    i.psi0 = a[PSI];
    i.psi1 = b[PSI];
    i.r0 = a[R];
    i.r1 = b[R];
    i.most_speed = i.fastest();
    for (const auto& o : obstacles)
      Search(i, footprint, o, plan.obstacle_time_held, margin, deepest).run();
  }
  return deepest;
}

}  // namespace slalom::planner
