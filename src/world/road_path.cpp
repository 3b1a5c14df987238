#include "road_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slalom::world {
namespace {

using vehicle::Parameters;
using vehicle::State;

/// Slower than this a state's slip and turn rate say little of where it goes: its steering does
/// [m/s].
constexpr double kSlow = 1;
/// Off the road's direction by this at the most [rad].
constexpr double kMostOff = 1;
/// Of lengths on a curve's inside.
constexpr double kLeastShrink = 0.2;
/// Steering is a difference over so many places on each side.
constexpr std::ptrdiff_t kAround = 2;

}  // namespace

double direction_of(const State& x, const Parameters& p) {
  if (x[vehicle::UX] < kSlow) return x[vehicle::PSI] + x[vehicle::SA];
  return x[vehicle::PSI] + std::atan2(x[vehicle::V] + p.la * x[vehicle::R], x[vehicle::UX]);
}

double curvature_of(const State& x, const Parameters& p) {
  if (x[vehicle::UX] < kSlow) return std::sin(x[vehicle::SA]) / (p.la + p.lb);
  return x[vehicle::R] / std::hypot(x[vehicle::UX], x[vehicle::V] + p.la * x[vehicle::R]);
}

RoadPath::RoadPath(const Road& road, const Parameters& vehicle, const State& start,
                   const OnRoad& on, const Course& course) {
  const RoadPlace at = road.at(on.s);
  const double heading = direction_of(start, vehicle), bend = curvature_of(start, vehicle);
  const double off =
      std::clamp(std::remainder(heading - at.psi, 2 * std::numbers::pi), -kMostOff, kMostOff);
  const double shrink = std::max(1 - at.curvature * on.n, kLeastShrink);
  // Of the path's offset as it is driven: its slope, and its second derivative, for at an offset n
  // the line's curvature is that over 1 - n times it.
  const double h = RoadBand::kStep, slope = std::tan(off) * shrink;
  const double second = bend / std::pow(std::cos(off), 3) * shrink * shrink - at.curvature * shrink;
  RoadBand band{on.s, {}, course.offset, course.over, course.spare, course.narrowings};
  for (std::size_t k = 0; k < band.first.size(); ++k) {
    const double s = h * static_cast<double>(k);
    band.first[k] = on.n + s * (slope + s * second / 2);
  }
  const auto count = static_cast<std::size_t>(course.length / h) + 4;
  const auto offsets = offsets_of(band, road, vehicle, count);
  std::vector<Point> points;
  for (std::size_t k = 0; k < count; ++k) {
    const RoadPlace place = road.at(on.s + h * static_cast<double>(k));
    points.push_back(place.point() + place.aside() * offsets[k]);
  }
  sample(points, heading);
  turn_body(vehicle, start[slalom::vehicle::PSI]);
}

/// Places evenly far apart along the spline through the points.
void RoadPath::sample(const std::vector<Point>& points, double heading) {
  double last = heading;
  double to = 0;  // the next place is so far from the point before
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Point &a = points[k], &b = points[k + 1];
    // Catmull and Rom's: through the points, in the directions of their neighbours.
    const Point from = k > 0 ? (b - points[k - 1]) * 0.5 : b - a;
    const Point into = k + 2 < points.size() ? (points[k + 2] - a) * 0.5 : b - a;
    const double length = (b - a).norm();
    for (; to < length; to += kStep) {
      const double u = to / length, w = 1 - u;
      const Point place = a * (w * w * (1 + 2 * u)) + b * (u * u * (3 - 2 * u)) +
                          from * (u * w * w) - into * (u * u * w);
      const Point rate =
          (b - a) * (6 * u * w) + from * (w * (w - 2 * u)) + into * (u * (u - 2 * w));
      last += std::remainder(std::atan2(rate.y, rate.x) - last, 2 * std::numbers::pi);
      places_.push_back({place.x, place.y, last, 0, 0, 0});
    }
    to -= length;
  }
}

/// The rear axle's centre moves along the body, which so follows the front axle's (a tractrix); the
/// steering angle is between the body and the way.
void RoadPath::turn_body(const Parameters& vehicle, double psi) {
  const double axles = vehicle.la + vehicle.lb;
  for (PathPlace& place : places_) {
    place.psi = psi;
    place.kappa = std::sin(std::clamp(place.heading - psi, -kMostOff, kMostOff)) / axles;
    psi += kStep * place.kappa;
  }
  const auto size = static_cast<std::ptrdiff_t>(places_.size());
  const auto steered = [&](std::ptrdiff_t k) {
    const PathPlace& place = places_[static_cast<std::size_t>(k)];
    return place.heading - place.psi;
  };
  for (std::ptrdiff_t k = 0; k < size; ++k) {
    const auto from = std::max<std::ptrdiff_t>(0, k - kAround),
               to = std::min(size - 1, k + kAround);
    if (from < to)
      places_[static_cast<std::size_t>(k)].steering =
          (steered(to) - steered(from)) / (kStep * static_cast<double>(to - from));
  }
}

std::size_t RoadPath::index(double s) const {
  const auto k = static_cast<std::size_t>(std::max(0., s / kStep + 0.5));
  return std::min(k, places_.size() - 1);
}

PathPlace RoadPath::at(double s) const {
  const double where = std::clamp(s / kStep, 0., static_cast<double>(places_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(where), places_.size() - 1);
  const PathPlace &a = places_[k], &b = places_[std::min(k + 1, places_.size() - 1)];
  const double share = where - static_cast<double>(k);
  const auto between = [share](double p, double q) { return p + share * (q - p); };
  return {between(a.x, b.x),     between(a.y, b.y),         between(a.heading, b.heading),
          between(a.psi, b.psi), between(a.kappa, b.kappa), between(a.steering, b.steering)};
}

}  // namespace slalom::world
