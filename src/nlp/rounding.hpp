#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "slalom/nlp/problem.hpp"

namespace slalom::nlp {

/// How well a row can be met: to so many roundings of its own terms, the sum of |slope * variable|.
/// Solvers and the independent check ask for no `constraint_tol` below that.
inline constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

/// Whether no more than rounding of its terms is `outside` a row's bounds, in the same unit.
inline bool is_rounding(double outside, double terms) {
  return outside <= kRounding * terms;
}

/// The terms of each row at a point.
inline void sum_terms(const Structure& shape, std::span<const double> jacobian,
                      std::span<const double> x, std::span<double> terms) {
  for (double& each : terms) each = 0;
  for (std::size_t t = 0; t < jacobian.size(); ++t)
    terms[shape.jacobian_row[t]] += std::fabs(jacobian[t] * x[shape.jacobian_col[t]]);
}

}  // namespace slalom::nlp
