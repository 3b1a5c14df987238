#pragma once

#include <algorithm>
#include <vector>

namespace slalom::ocp {

/// Linear interpolation of rows[point][i] given at `tau`; constant beyond the ends.
inline double between_points(const std::vector<double>& tau,
                             const std::vector<std::vector<double>>& rows, std::size_t i,
                             double at) {
  const auto above = std::upper_bound(tau.begin(), tau.end(), at);
  if (above == tau.begin()) return rows.front()[i];
  const auto k = static_cast<std::size_t>(above - tau.begin());
  if (k == tau.size()) return rows.back()[i];
  const double share = (at - tau[k - 1]) / (tau[k] - tau[k - 1]);
  return rows[k - 1][i] + share * (rows[k][i] - rows[k - 1][i]);
}

}  // namespace slalom::ocp
