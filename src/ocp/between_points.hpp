#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slalom::ocp {

/// Linear interpolation of value(point) at the points of `tau`, constant beyond the ends; where two
/// points stand at `at`, the limit from the left or from the right.
template <class Value>
double between_points(const std::vector<double>& tau, const Value& value, double at,
                      bool from_left = false) {
  const auto above = from_left ? std::lower_bound(tau.begin(), tau.end(), at)
                               : std::upper_bound(tau.begin(), tau.end(), at);
  if (above == tau.begin()) return value(std::size_t{0});
  const auto k = static_cast<std::size_t>(above - tau.begin());
  if (k == tau.size()) return value(k - 1);
  const double share = (at - tau[k - 1]) / (tau[k] - tau[k - 1]);
  return value(k - 1) + share * (value(k) - value(k - 1));
}

/// Of rows[point][i].
inline double between_points(const std::vector<double>& tau,
                             const std::vector<std::vector<double>>& rows, std::size_t i,
                             double at) {
  return between_points(
      tau, [&](std::size_t point) { return rows[point][i]; }, at);
}

/// The part of the horizon that stands for a point: half of the way to each neighbour. A scheme's
/// own weight may be 0.
inline double share_of(const std::vector<double>& tau, std::size_t point) {
  const double before = point > 0 ? tau[point] - tau[point - 1] : 0;
  const double after = point + 1 < tau.size() ? tau[point + 1] - tau[point] : 0;
  return (before + after) / 2;
}

}  // namespace slalom::ocp
