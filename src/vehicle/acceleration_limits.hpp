#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "slalom/expr/expr.hpp"
#include "slalom/vehicle/parameters.hpp"

/// Limits of longitudinal acceleration, stated once for numbers (T = double) and for expressions.
namespace slalom::vehicle::acceleration {

using std::sqrt;

/// Where two limits cross, the one that holds is rounded, and half of this below both [m/s^2].
inline constexpr double kRounding = 0.2;
/// Power divides by a speed of no less than this, so that it limits nothing at standstill [m/s].
inline constexpr double kSlow = 1;

/// A cubic, highest power first (formulation section 2, limits of ax).
template <class T>
T cubic(const std::array<double, 4>& c, const T& x) {
  return ((c[0] * x + c[1]) * x + c[2]) * x + c[3];
}

/// At most the lesser of two, and smooth.
template <class T>
T lesser(const T& a, const T& b) {
  const T apart = a - b;
  return (a + b - sqrt(apart * apart + kRounding * kRounding)) / 2;
}

/// The longitudinal acceleration [m/s^2] at which the first axle's force is `friction_share` of its
/// friction PDX1 Fz, driving (`forward` 1) or braking (-1) with `front` of the force in front. The
/// axle loads are those of the acceleration: FzF0 - KZX a, FzR0 + KZX a.
inline double by_friction(const Parameters& p, double forward, double front) {
  const double mu = p.friction_share * p.PDX1;
  const auto of_axle = [&](double part, double load, double transfer) {
    const double gained = part * p.m + mu * transfer;  // force less friction, for each m/s^2
    return gained > 0 ? mu * load / gained : std::numeric_limits<double>::infinity();
  };
  return std::min(of_axle(front, p.FzF0, forward * p.KZX),
                  of_axle(1 - front, p.FzR0, -forward * p.KZX));
}

/// Greatest acceleration [m/s^2] at speed ux [m/s]: the cubic, and below it P/(m ux) and friction
/// where the vehicle states them.
template <class T>
T most(const Parameters& p, const T& ux) {
  T limit = cubic(p.ax_max, ux);
  if (p.power > 0) limit = lesser<T>(limit, p.power / p.m / sqrt(ux * ux + kSlow * kSlow));
  if (p.friction_share > 0) limit = lesser<T>(limit, T(by_friction(p, 1, p.drive_front)));
  return limit;
}

/// Least acceleration [m/s^2], greatest deceleration, likewise.
template <class T>
T least(const Parameters& p, const T& ux) {
  const T limit = cubic(p.ax_min, ux);
  if (!(p.friction_share > 0)) return limit;
  return -lesser<T>(-limit, T(by_friction(p, -1, p.brake_front)));
}

}  // namespace slalom::vehicle::acceleration
