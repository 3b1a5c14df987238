#include "motion.hpp"

#include <algorithm>

namespace slalom::planner {
namespace {

/// Values at knots, linear between them.
template <class Value>
Value between(const std::vector<double>& t, const std::vector<Value>& values, double at) {
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

}  // namespace

vehicle::State Motion::state_at(double at) const {
  return between(t, states, at);
}

vehicle::Control Motion::control_at(double at) const {
  return between(t, controls, at);
}

}  // namespace slalom::planner
