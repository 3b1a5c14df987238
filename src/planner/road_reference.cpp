#include "road_reference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "references.hpp"
#include "slalom/vehicle/agility.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Knots are this far apart [s].
constexpr double kKnot = 0.05;
/// Beside the body to the road's edge [m].
constexpr double kSpare = 0.3;
/// The same of a vehicle that moves over at once, and the way of so many seconds that it takes.
constexpr double kTightSpare = 0.1, kQuickTime = 0.15;
/// The vehicle turns into the road's direction within a way of so many seconds at its speed, and so
/// many metres at the least; it is off that by this at the most [rad].
constexpr double kTurnTime = 0.5, kTurnLength = 5, kMostOff = 0.6;
constexpr double kBraking = 3;        ///< beyond a motion's end [m/s^2]
constexpr double kLeastShrink = 0.2;  ///< of lengths on a curve's inside

/// The offset from the line a way further on: that wanted, which it comes to without overshoot.
class Offset {
 public:
  Offset(double now, double wanted, double slope, double length)
      : wanted_(wanted), off_(now - wanted), rate_(slope + off_ / length), length_(length) {}

  double value(double way) const { return wanted_ + (off_ + rate_ * way) * fade(way); }
  double slope(double way) const { return (rate_ - (off_ + rate_ * way) / length_) * fade(way); }

 private:
  double fade(double way) const { return std::exp(-way / length_); }
  double wanted_, off_, rate_, length_;
};

double wanted_offset(double now, const world::RoadPlace& at, const Parameters& vehicle,
                     double aside) {
  const bool point = vehicle.footprint == FootprintKind::point;
  const double half = (point ? 0 : vehicle.width / 2) + (aside == 0 ? kSpare : kTightSpare);
  const double right = half - at.right, left = at.left - half;
  if (!(right < left)) return (at.left - at.right) / 2;
  const double here = std::clamp(now, right, left);
  return here + (aside < 0 ? here - right : left - here) * aside;
}

}  // namespace

Motion road_reference(const world::Road& road, const State& X0, double t0, double duration,
                      double deceleration, const Parameters& vehicle, double aside) {
  return road_reference(road, road.project({X0[X], X0[Y]}), X0, t0, duration, deceleration, vehicle,
                        aside);
}

Motion road_reference(const world::Road& road, const world::OnRoad& on, const State& X0, double t0,
                      double duration, double deceleration, const Parameters& vehicle,
                      double aside) {
  const double creep = standing_of(vehicle, true).creep;
  double v = std::max(X0[UX], creep), s = on.s, way = 0;
  const double heading = X0[PSI] + std::atan2(X0[V] + vehicle.la * X0[R], v);
  world::RoadPlace at = road.at(s);
  const double off = std::remainder(heading - at.psi, 2 * std::numbers::pi);
  const double length =
      aside == 0 ? std::max(kTurnLength, kTurnTime * v) : std::max(kTurnLength / 2, kQuickTime * v);
  const Offset offset(on.n, wanted_offset(on.n, at, vehicle, aside),
                      std::tan(std::clamp(off, -kMostOff, kMostOff)), length);
  world::Way points;
  // Headings go on from that of the start, without jumps of whole turns.
  double last = heading;
  for (double t = t0; t < t0 + duration + kKnot / 2; t += kKnot) {
    const double n = offset.value(way);
    const double shrink = std::max(1 - at.curvature * n, kLeastShrink);
    const world::Point place = at.point() + at.aside() * n;
    const double along = at.psi + std::atan(offset.slope(way) / shrink);
    last += std::remainder(along - last, 2 * std::numbers::pi);
    points.push_back({t, place.x, place.y, last, v, 0, v > creep ? -deceleration : 0});
    const double slower = std::max(creep, v - deceleration * kKnot);
    const double step = kKnot * (v + slower) / 2;
    way += step;
    s += step / shrink;
    v = slower;
    at = road.at(s);
  }
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    points[k].kappa = (points[k + 1].heading - points[k].heading) /
                      std::hypot(points[k + 1].x - points[k].x, points[k + 1].y - points[k].y);
  if (points.size() > 1) points.back().kappa = points[points.size() - 2].kappa;
  return reference_of(points, vehicle);
}

Motion braked_on(Motion motion, const Parameters& vehicle, const world::Road* road, double beyond) {
  if (road == nullptr) return braked_on(std::move(motion), vehicle, beyond);
  const Motion on = road_reference(*road, motion.states.back(), motion.end(), beyond,
                                   kBraking * agility(vehicle).braking, vehicle);
  for (std::size_t k = 1; k < on.size(); ++k) motion.add(on.t[k], on.states[k], on.controls[k]);
  return motion;
}

}  // namespace slalom::planner
