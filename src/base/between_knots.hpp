#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slalom {

/// Arrays of numbers `values` at the knots `t`, which do not decrease, linear between them: the
/// value at `at`, the first before the knots and the last after them. There is one knot at least.
template <class Value>
Value between_knots(const std::vector<double>& t, const std::vector<Value>& values, double at) {
  const auto next = std::upper_bound(t.begin(), t.end(), at);
  if (next == t.begin()) return values.front();
  if (next == t.end()) return values.back();
  const auto k = static_cast<std::size_t>(next - t.begin());
  const double share = (at - t[k - 1]) / (t[k] - t[k - 1]);
  Value result;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = values[k - 1][i] + share * (values[k][i] - values[k - 1][i]);
  return result;
}

}  // namespace slalom
