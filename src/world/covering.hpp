#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "slalom/world/footprint.hpp"

namespace slalom::world {

/// Discs of one radius along the middle of a rectangle, `ahead` of its centre, that cover it: the
/// fewest that stick out of its long sides by at most `excess` [m]; kMostDiscs if that is too few.
inline std::vector<Disc> discs_along(double length, double width, double excess) {
  const double half = width / 2, radius = half + excess;
  const double part = 2 * std::sqrt(radius * radius - half * half);
  const double wanted = std::clamp(std::ceil(length / part - 1e-9), 1.0, double{kMostDiscs});
  std::vector<Disc> discs;
  for (double k = 0; k < wanted; ++k)
    discs.push_back({length * ((k + 0.5) / wanted - 0.5), std::hypot(length / wanted / 2, half)});
  return discs;
}

}  // namespace slalom::world
