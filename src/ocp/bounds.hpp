#pragma once

#include <algorithm>
#include <cmath>

#include "slalom/ocp/problem.hpp"

namespace slalom::ocp {

inline Bounds intersection(Bounds a, Bounds b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

/// Of a state at one end of the horizon, over which its own hold too.
inline Bounds end_bounds(const Problem::State& state, bool final) {
  return intersection(state.bounds, final ? state.final : state.initial);
}

/// Whether bounds say where between them a value is.
inline bool tells_a_value(Bounds bounds) {
  return std::isfinite(bounds.lower) && std::isfinite(bounds.upper);
}

}  // namespace slalom::ocp
