#include "constant_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace slalom::ocp {
namespace {

/// Of a scaled row's size: what rounding of numbers that should be equal may leave.
constexpr double kRounding = 1e-12;

}  // namespace

void relax_constant_rows(
    const nlp::Structure& shape,
    const std::function<std::vector<double>(const std::vector<double>& x)>& rows,
    nlp::Limits& limits) {
  std::vector<char> constant(shape.rows);
  std::vector<double> size(shape.rows, 1.0);
  for (std::size_t r = 0; r < shape.rows; ++r) constant[r] = limits.gl[r] == limits.gu[r];
  for (std::size_t e = 0; e < shape.jacobian_row.size(); ++e) {
    const std::size_t row = shape.jacobian_row[e], col = shape.jacobian_col[e];
    if (limits.xl[col] < limits.xu[col])
      constant[row] = 0;
    else
      size[row] = std::max(size[row], std::fabs(limits.xl[col]));
  }
  if (std::none_of(constant.begin(), constant.end(), [](char each) { return each != 0; })) return;
  std::vector<double> x(shape.variables, 0.0);  // of which those rows see the fixed ones alone
  for (std::size_t i = 0; i < x.size(); ++i)
    if (limits.xl[i] == limits.xu[i]) x[i] = limits.xl[i];
  const std::vector<double> values = rows(x);
  for (std::size_t r = 0; r < shape.rows; ++r)
    if (constant[r] && std::fabs(values[r] - limits.gl[r]) <= kRounding * size[r]) {
      limits.gl[r] = -std::numeric_limits<double>::infinity();
      limits.gu[r] = std::numeric_limits<double>::infinity();
    }
}

}  // namespace slalom::ocp
