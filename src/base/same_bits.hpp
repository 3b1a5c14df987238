#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace slalom {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Of two lists of numbers.
template <class Numbers>
bool same_bits(const Numbers& a, const Numbers& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return same_bits(x, y); });
}

}  // namespace slalom
