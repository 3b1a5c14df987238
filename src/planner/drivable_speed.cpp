#include "drivable_speed.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::planner {
namespace {

using vehicle::Parameters;

/// Lengths over which the curvature of a path may change [m].
constexpr double kShortest = 4, kLongest = 60, kStep = 2;
/// Of the room beside the vehicle so much is left [m]; and of a narrow road so much is taken.
constexpr double kSpare = 0.5, kLeast = 0.05;
/// A vehicle steers at this share of its greatest rate.
constexpr double kSteering = 0.9;

}  // namespace

double steerable_speed(const world::Road& road, const Parameters& vehicle, double s) {
  const auto at = road.at(s);
  const double body = vehicle.footprint == vehicle::FootprintKind::point ? 0 : vehicle.width;
  const double room = std::max((at.left + at.right - body) / 2 - kSpare, kLeast);
  // Of curvature, the front wheels at an angle sa have tan(sa) / (la + lb).
  const double rate = kSteering * vehicle.sr_max() / (vehicle.la + vehicle.lb);
  double change = 0, speed = 0;
  for (double length = kShortest; length <= kLongest; length += kStep) {
    change = std::max(
        change, std::fabs(road.at(s + length / 2).curvature - road.at(s - length / 2).curvature));
    if (length > kShortest && change * length * length / 24 > room) break;
    speed = change > 0 ? std::min(rate * length / change, vehicle.ux_max) : vehicle.ux_max;
  }
  return speed;
}

SpeedProfile drivable_speeds(const world::Road& road, const Parameters& vehicle,
                             double lateral_share, double braking_share) {
  return {road, vehicle, lateral_share, braking_share,
          [&](double s) { return steerable_speed(road, vehicle, s); }};
}

}  // namespace slalom::planner
