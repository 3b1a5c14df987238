#include "checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "slalom/base/error.hpp"
#include "symbols.hpp"

namespace slalom::ocp {

void check_bounds(const std::string& where, Bounds bounds) {
  if (std::isnan(bounds.lower) || std::isnan(bounds.upper))
    throw InvalidValue(where, "NaN in its bounds", "numbers");
  if (bounds.lower > bounds.upper)
    throw InvalidValue(where, fmt::format("bounds {} to {}", bounds.lower, bounds.upper),
                       "a lower bound not above the upper one");
  if (bounds.lower == kInfinity || bounds.upper == -kInfinity)
    throw InvalidValue(where, fmt::format("bounds {} to {}", bounds.lower, bounds.upper),
                       "bounds that some number satisfies");
}

void check_row_bounds(const std::string& where, Bounds bounds) {
  check_bounds(where, bounds);
  if (!bounds.bounded())
    throw InvalidValue(where, "no bounds", "a lower or upper bound, or a number that it equals");
}

void check_times(const Problem& problem) {
  const Bounds &t0 = problem.t0().bounds, &tf = problem.tf().bounds;
  if (tf.upper < t0.lower)
    throw InvalidValue(
        problem.name() + ": tf",
        fmt::format("bounds {} to {}, t0 from {} to {}", tf.lower, tf.upper, t0.lower, t0.upper),
        "bounds with some tf >= t0");
}

void check_rows(const Problem& problem, const Transcribed& data) {
  const auto& shape = data.structure;
  std::vector<char> changes(shape.rows, 0);
  for (std::size_t e = 0; e < shape.jacobian_row.size(); ++e) {
    const std::size_t variable = shape.jacobian_col[e];
    const bool fixed = (variable == data.layout.t0 && is_fixed(problem.t0())) ||
                       (variable == data.layout.tf && is_fixed(problem.tf()));
    if (!fixed) changes[shape.jacobian_row[e]] = 1;
  }
  for (std::size_t r = 0; r < shape.rows; ++r)
    if (changes[r] == 0)
      throw InvalidValue(problem.name() + ": " + data.row_names[r].in(problem),
                         "a function of no variable", "one that some variable can change");
}

}  // namespace slalom::ocp
