#pragma once

// Searches along a stretch for lows and crossings of a function of the seconds since it began.

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <optional>

namespace slalom::sim::searches {

/// Roots are located to this [s].
inline constexpr double kTimeTolerance = 1e-10;
/// Of a distance with several minima, lows less deep than half of this may be missed [m], and
/// others are found to within kLow [m].
inline constexpr double kGraze = 1e-4, kLow = 1e-3;
/// After so many looks in a stretch, the others are evenly apart and as many at most: whatever the
/// speeds, a stretch is soon judged.
inline constexpr int kMostLooks = 1000;
/// Share of a stretch over which one-sided differences are taken.
inline constexpr double kDifference = 1e-3;

/// A value and when it is taken, in seconds since the stretch began.
struct Low {
  double t, value;
};

/// Least value of `f` over (0, length), when it has one minimum there; Brent's method.
template <class F>
Low lowest(const F& f, double length) {
  std::uintmax_t iterations = 60;
  const auto [t, value] = boost::math::tools::brent_find_minima(f, 0., length, 26, iterations);
  return {t, value};
}

/// Whether `f`, of one minimum, has it between two times: it falls after the first and rises before
/// the second.
template <class F>
bool dips_between(const F& f, double t0, double f0, double t1, double f1) {
  const double dt = kDifference * (t1 - t0);
  return f(t0 + dt) < f0 && f(t1 - dt) < f1;
}

/// First time in (0, end] at which `f` is no longer positive, given f(0) > 0 >= f(end) and one sign
/// change; Alefeld, Potra and Shi's algorithm 748.
template <class F>
double crossing(const F& f, double f0, double end, double f_end) {
  if (f0 <= 0) return 0;
  if (f_end == 0) return end;
  std::uintmax_t iterations = 100;
  const auto close = [](double low, double high) { return high - low <= kTimeTolerance; };
  return boost::math::tools::toms748_solve(f, 0., end, f0, f_end, close, iterations).second;
}

/// First time at which the convex `f` (one minimum) is no longer positive within [0, length], given
/// its values at both ends and a bound of |f'|.
template <class F>
std::optional<double> first_entry(const F& f, double length, double f0, double f1, double rate) {
  if (f0 < 0) return 0.;
  if (f1 < 0) return crossing(f, f0, length, f1);
  if (f0 + f1 >= rate * length) return std::nullopt;
  const Low low = lowest(f, length);
  if (low.value >= 0) return std::nullopt;
  return crossing(f, f0, low.t, low.value);
}

/// First time in [from, to] at which `f`, which falls no faster than `rate`, is negative, whatever
/// its shape: it is looked at again when it could be, which is conservative advancement (B. V.
/// Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, section 2.3).
template <class F>
std::optional<double> first_touch(const F& f, double from, double f_from, double to, double rate) {
  double value = f_from;
  int looks = 0;
  if (value < 0) return from;
  for (double t = from; t < to;) {
    const double least_step = ++looks > kMostLooks ? (to - from) / kMostLooks : 0;
    const double next = std::min(to, t + std::max(std::max(value, kGraze) / rate, least_step));
    const double then = f(next);
    if (then < 0)
      return t + crossing([&](double after) { return f(t + after); }, value, next - t, then);
    t = next;
    value = then;
  }
  return std::nullopt;
}

/// Lowers `low` to the least of `f` between two times, to within kLow, if `rate` allows any there.
template <class F>
void look_between(const F& f, double t0, double f0, double t1, double f1, double rate,
                  double least_step, Low& low) {
  if ((f0 + f1 - rate * (t1 - t0)) / 2 >= low.value - kLow || t1 - t0 <= least_step) return;
  const double t = (t0 + t1) / 2, value = f(t);
  if (value < low.value) low = {t, value};
  look_between(f, t0, f0, t, value, rate, least_step, low);
  look_between(f, t, value, t1, f1, rate, least_step, low);
}

}  // namespace slalom::sim::searches
