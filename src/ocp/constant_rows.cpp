#include "constant_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace slalom::ocp {
namespace {

/// Of a scaled row's size: what rounding of numbers that should be equal may leave.
constexpr double kRounding = 1e-12;

}  // namespace

ConstantRows::ConstantRows(const nlp::Structure& shape)
    : columns_(shape.jacobian_row.size()), begin_(shape.rows + 1, 0) {
  for (const auto row : shape.jacobian_row) ++begin_[row + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  auto next = begin_;
  for (std::size_t e = 0; e < columns_.size(); ++e)
    columns_[next[shape.jacobian_row[e]]++] = static_cast<std::uint32_t>(shape.jacobian_col[e]);
}

void ConstantRows::relax(
    const std::function<std::vector<double>(const std::vector<double>& x)>& rows,
    nlp::Limits& limits) const {
  const auto is_free = [&](std::size_t column) { return limits.xl[column] < limits.xu[column]; };
  std::vector<std::size_t> constant;
  for (std::size_t r = 0; r + 1 < begin_.size(); ++r)
    if (limits.gl[r] == limits.gu[r] &&
        std::none_of(columns_.begin() + static_cast<std::ptrdiff_t>(begin_[r]),
                     columns_.begin() + static_cast<std::ptrdiff_t>(begin_[r + 1]), is_free))
      constant.push_back(r);
  if (constant.empty()) return;
  std::vector<double> x(limits.xl.size(), 0.0);  // of which those rows see the fixed ones alone
  for (std::size_t i = 0; i < x.size(); ++i)
    if (limits.xl[i] == limits.xu[i]) x[i] = limits.xl[i];
  const std::vector<double> values = rows(x);
  for (const std::size_t r : constant) {
    double size = 1;
    for (std::size_t e = begin_[r]; e < begin_[r + 1]; ++e)
      size = std::max(size, std::fabs(limits.xl[columns_[e]]));
    if (!(std::fabs(values[r] - limits.gl[r]) <= kRounding * size)) continue;
    limits.gl[r] = -std::numeric_limits<double>::infinity();
    limits.gu[r] = std::numeric_limits<double>::infinity();
  }
}

}  // namespace slalom::ocp
