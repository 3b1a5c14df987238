#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace slalom::report {

// Numbers as a page carries them: no longer than a screen can show.

inline constexpr int kStateDigits[] = {4, 4, 5, 5, 5, 6, 4, 4};
inline constexpr int kControlDigits[] = {6, 5};
inline constexpr int kTimeDigits = 6;

/// `value` with `digits` decimals; null when it is not finite.
inline nlohmann::ordered_json rounded(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double power = std::pow(10.0, digits);
  const double scaled = std::round(value * power);
  if (!std::isfinite(scaled) || std::abs(scaled) > 1e15) return value;
  const double result = scaled / power;
  return result == 0 ? nlohmann::ordered_json(0) : nlohmann::ordered_json(result);
}

/// `value` as it is; null when it is not finite.
inline nlohmann::ordered_json exact(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace slalom::report
