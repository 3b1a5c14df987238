#include "number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace slalom::io {
namespace {

/// Of a decimal number without a sign that no double holds: whether it is too small, not too large.
bool too_small(std::string_view text) {
  const auto e = std::min(text.find_first_of("eE"), text.size());
  const auto mantissa = text.substr(0, e);
  const auto first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return true;
  auto exponent = text.substr(std::min(e + 1, text.size()));
  if (exponent.starts_with('+')) exponent.remove_prefix(1);
  std::int64_t power = 0;
  const auto read = std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
  if (read.ec == std::errc::result_out_of_range) return exponent.starts_with('-');
  const auto point = static_cast<double>(std::min(mantissa.find('.'), mantissa.size()));
  return point - static_cast<double>(first) + static_cast<double>(power) < 0;
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (text.empty() || text.starts_with('-') || text.starts_with('+')) return std::nullopt;
  const double sign = negative ? -1 : 1;
  for (const char* infinity : {".inf", ".Inf", ".INF"})
    if (text == infinity) return sign * HUGE_VAL;
  for (const char* nan : {".nan", ".NaN", ".NAN"})
    if (!negative && text == nan) return std::nan("");
  const char* end = text.data() + text.size();
  double number = 0;
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ptr != end) return std::nullopt;
  if (read.ec == std::errc::result_out_of_range) return sign * (too_small(text) ? 0 : HUGE_VAL);
  if (read.ec != std::errc()) return std::nullopt;
  return sign * number;
}

}  // namespace slalom::io
