#include "off_road.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::sim {
namespace {

using vehicle::State;

constexpr double kGraze = 5e-5;           ///< [m]
constexpr double kTimeTolerance = 1e-10;  ///< [s]

/// Bound of the speed [m/s] of any point of the footprint; the margins cover accelerations of 50
/// m/s^2 and 100 rad/s^2 over .02 s.
double fastest(const vehicle::Dynamics& dynamics, const world::Footprint& footprint,
               const Stretch& stretch) {
  double speed = 0, turn = 0;
  for (const State* state : {&stretch.state0, &stretch.state1}) {
    const State rate = dynamics.derivative(*state, {});
    speed = std::max(speed, std::hypot(rate[vehicle::X], rate[vehicle::Y]));
    turn = std::max(turn, std::fabs((*state)[vehicle::R]));
  }
  return 1.1 * speed + 1 + (1.1 * turn + 2) * footprint.reach();
}

}  // namespace

std::optional<double> first_off_road(const world::Road& road, const world::Footprint& footprint,
                                     const vehicle::Dynamics& dynamics, const Stretch& s) {
  const auto distance = [&](double t) { return footprint.edge_distance(road, s.at(s.t0 + t)); };
  const double length = s.t1 - s.t0, rate = fastest(dynamics, footprint, s);
  double value = footprint.edge_distance(road, s.state0);
  if (value < 0) return 0.;
  if (value > rate * length) return std::nullopt;
  for (double t = 0; t < length;) {
    double next = std::min(length, t + std::max(value, kGraze) / rate);
    value = distance(next);
    if (value < 0) {
      while (next - t > kTimeTolerance) {
        const double middle = (t + next) / 2;
        (distance(middle) < 0 ? next : t) = middle;
      }
      return next;
    }
    t = next;
  }
  return std::nullopt;
}

}  // namespace slalom::sim
