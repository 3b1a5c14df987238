#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>

namespace slalom::sim {

/// Draws of the standard normal distribution, by inversion, so that the same seed gives the same
/// bits with every standard library.
class NormalDraws {
 public:
  explicit NormalDraws(std::initializer_list<std::uint32_t> seed);
  double next();

 private:
  std::mt19937_64 generator_;
};

}  // namespace slalom::sim
