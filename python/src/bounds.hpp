#pragma once

#include <optional>
#include <utility>
#include <variant>

#include "slalom/base/error.hpp"
#include "slalom/ocp/problem.hpp"

namespace slalom::python {

/// A bound; absent where Python says None.
using Limit = std::optional<double>;
/// Bounds at one end of the horizon: a number that the state equals, or a pair (lower, upper).
using EndBounds = std::variant<double, std::pair<Limit, Limit>>;

inline ocp::Bounds bounds(Limit lower, Limit upper) {
  return {lower.value_or(-ocp::kInfinity), upper.value_or(ocp::kInfinity)};
}

inline ocp::Bounds bounds(Limit lower, Limit upper, Limit equal) {
  if (!equal) return bounds(lower, upper);
  if (lower || upper)
    throw InvalidValue("bounds", "equal beside lower or upper", "one or the other");
  return ocp::Bounds::equal(*equal);
}

inline ocp::Bounds bounds(const EndBounds& end) {
  if (const auto* value = std::get_if<double>(&end)) return ocp::Bounds::equal(*value);
  const auto& [lower, upper] = std::get<std::pair<Limit, Limit>>(end);
  return bounds(lower, upper);
}

}  // namespace slalom::python
