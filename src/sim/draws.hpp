#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <random>
#include <vector>

namespace slalom::sim {

/// Draws of the standard normal distribution, by inversion, so that the same seed gives the same
/// bits with every standard library.
class NormalDraws {
 public:
  explicit NormalDraws(std::initializer_list<std::uint32_t> seed) : seed_(seed) {}
  double next();
  /// Leaves a draw out, which costs nothing.
  void skip() { ++skipped_; }

 private:
  std::vector<std::uint32_t> seed_;
  unsigned long long skipped_ = 0;
  std::optional<std::mt19937_64>
      generator_;  ///< made for the first draw: seeding takes microseconds
};

}  // namespace slalom::sim
