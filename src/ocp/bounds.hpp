#pragma once

#include <algorithm>
#include <cmath>

#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

inline Bounds intersection(Bounds a, Bounds b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

/// Whether bounds say where between them a value is.
inline bool tells_a_value(Bounds bounds) {
  return std::isfinite(bounds.lower) && std::isfinite(bounds.upper);
}

}  // namespace slalom::ocp
