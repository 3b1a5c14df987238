#include "between_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

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
  /// The most that any point within `reach` [m] of the place accelerates by [m/s^2]: a cubic's
  /// second derivative is linear, so that its ends bound it.
  double most_acceleration(double reach) const {
    const Vector chord = (p1 - p0) * (6 / length);
    const double turned = (psi1 - psi0) * (6 / length), turn = fastest_turn();
    const double place =
        std::max((chord - v0 * 4 - v1 * 2).norm(), (v0 * 2 + v1 * 4 - chord).norm());
    const double heading =
        std::max(std::fabs(turned - 4 * r0 - 2 * r1), std::fabs(2 * r0 + 4 * r1 - turned));
    return (place + heading * reach) / length + turn * turn * reach;
  }
};

/// From node k of a plan to the next.
Interval interval(const Plan& plan, std::size_t k, double la) {
  Interval i;
  i.t0 = plan.t_start + plan.t[k];
  i.length = plan.t[k + 1] - plan.t[k];
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
  return i;
}

/// An obstacle, with what is the same for all intervals.
struct Body {
  const world::Obstacle& obstacle;
  double reach;   ///< sum of its own, the footprint's and the margin [m]
  double moving;  ///< what its margin is gone into by while it comes closer, if constant [m/s]
};

/// Looks for where an interval is deepest within an obstacle's margin.
class Search {
 public:
  Search(const Interval& interval, const world::Footprint& footprint, std::optional<double> held,
         double margin, Passage& deepest)
      : interval_(interval),
        footprint_(footprint),
        held_(held),
        margin_(margin),
        begin_(time(0)),
        end_(time(1)),
        turning_(footprint.is_point()
                     ? 0
                     : interval.fastest_turn() * footprint.reach() * interval.length),
        deepest_(deepest) {}

  void run(const Body& body) {
    const world::Obstacle& o = body.obstacle;
    if (!o.present(begin_, end_)) return;
    const double moving =
        o.trajectory && !held_ ? o.fastest(begin_, end_) + o.margin_rate : body.moving;
    const double rate = (interval_.most_speed + moving) * interval_.length + turning_;
    // Far ones, which are most, are told by the distance between centres.
    const double near = body.reach + o.margin(begin_) - deepest_.depth + rate;
    const Vector apart = interval_.p0 - Vector{o.x_at(begin_), o.y_at(begin_)};
    if (near < 0 || dot(apart, apart) > near * near) return;
    obstacle_ = &o;
    rate_ = rate;
    split(0, depth(0), 1, depth(1));
  }

 private:
  double time(double share) const {
    return held_.value_or(interval_.t0 + share * interval_.length);
  }
  double depth(double share) {
    const double d = margin_ + obstacle_->margin(time(share)) -
                     footprint_.distance(*obstacle_, interval_.at(share), time(share));
    if (d > deepest_.depth + kPassageResolution / 2)
      deepest_ = {d, obstacle_->name, interval_.t0 + share * interval_.length};
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
  const std::optional<double> held_;
  const double margin_;
  const double begin_, end_;  ///< [s]
  const double turning_;      ///< what a body's turn adds to the rate [m]
  Passage& deepest_;
  const world::Obstacle* obstacle_ = nullptr;
  double rate_ = 0;  ///< the most that depth changes by along the interval [m]
};

/// Looks for where an interval is farthest beyond an edge of the road. Between two moments each
/// point of the footprint is off its chord, and an edge bends away from its own, by at most the
/// second derivatives' bounds times the square of the duration over 8, as in Verifier.
class EdgeSearch {
 public:
  EdgeSearch(const Interval& interval, const world::Road& road, const world::Footprint& footprint,
             RoadExit& farthest)
      : interval_(interval), road_(road), footprint_(footprint), farthest_(farthest) {
    const double reach = footprint.reach();
    const double fast = interval.most_speed + interval.fastest_turn() * reach;
    bend_ = (interval.most_acceleration(reach) + road.sharpest() * fast * fast) * interval.length *
            interval.length / 8;
  }

  /// Its ends are nodes, where the rows of the edges hold; what they leave is not reported.
  void run() { split(0, beyond(0), 1, beyond(1)); }

 private:
  double beyond(double share) const {
    return -footprint_.edge_distance(road_, interval_.at(share));
  }
  void split(double s0, double d0, double s1, double d1) {
    const double off = bend_ * (s1 - s0) * (s1 - s0);
    const double wanted = std::max(farthest_.depth, kPassageResolution / 2);
    if (std::max(d0, d1) + off <= wanted + kPassageResolution / 2) return;
    if (off < kPassageResolution / 2) return;
    const double middle = (s0 + s1) / 2, d = beyond(middle);
    if (d > wanted + kPassageResolution / 2) note(middle, d);
    split(s0, d0, middle, d);
    split(middle, d, s1, d1);
  }
  void note(double share, double depth) {
    const State state = interval_.at(share);
    auto corners = footprint_.at(state);
    if (corners.empty()) corners.push_back({state[X], state[Y]});
    farthest_ = {depth, false, interval_.t0 + share * interval_.length};
    double most = -INFINITY;
    for (const Vector& corner : corners) {
      const world::OnRoad on = road_.project(corner);
      const world::RoadPlace at = road_.at(on.s);
      const bool left = on.n - at.left > -on.n - at.right;
      const double out = left ? on.n - at.left : -on.n - at.right;
      if (out <= most) continue;
      most = out;
      farthest_.left = left;
    }
  }

  const Interval& interval_;
  const world::Road& road_;
  const world::Footprint& footprint_;
  RoadExit& farthest_;
  double bend_ = 0;  ///< of the distance to an edge, along the whole interval [m]
};

}  // namespace

Passage deepest_passage(const Plan& plan, const std::vector<world::Obstacle>& obstacles,
                        double margin, const world::Footprint& footprint, double la) {
  Passage deepest;
  std::vector<Body> bodies;
  for (const auto& o : obstacles)
    bodies.push_back(
        {o, o.reach() + footprint.reach() + margin,
         plan.obstacle_time_held || o.trajectory ? 0 : o.fastest(0, 0) + o.margin_rate});
  for (std::size_t k = 0; k + 1 < plan.t.size(); ++k) {
    if (!(plan.t[k + 1] > plan.t[k])) return deepest;
    const Interval i = interval(plan, k, la);
    Search search(i, footprint, plan.obstacle_time_held, margin, deepest);
    for (const Body& body : bodies) search.run(body);
  }
  return deepest;
}

double deepest_at_nodes(const Plan& plan, const std::vector<world::Obstacle>& obstacles,
                        double margin, const world::Footprint& footprint) {
  double deepest = 0;
  for (std::size_t k = 0; k < plan.t.size(); ++k) {
    const double t = plan.obstacle_time(k);
    for (const auto& o : obstacles)
      if (o.present(t, t))
        deepest =
            std::max(deepest, margin + o.margin(t) - footprint.distance(o, plan.states[k], t));
  }
  return deepest;
}

RoadExit farthest_exit(const Plan& plan, const world::Road& road, const world::Footprint& footprint,
                       double la) {
  RoadExit farthest;
  for (std::size_t k = 0; k + 1 < plan.t.size() && plan.t[k + 1] > plan.t[k]; ++k) {
    const Interval i = interval(plan, k, la);
    EdgeSearch(i, road, footprint, farthest).run();
  }
  return farthest;
}

}  // namespace slalom::planner
