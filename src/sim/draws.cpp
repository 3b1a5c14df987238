#include "draws.hpp"

#include <boost/math/distributions/normal.hpp>

namespace slalom::sim {

NormalDraws::NormalDraws(std::initializer_list<std::uint32_t> seed) {
  std::seed_seq mix(seed);
  generator_.seed(mix);
}

double NormalDraws::next() {
  const double u = (static_cast<double>(generator_() >> 11U) + 0.5) * 0x1p-53;
  const boost::math::normal_distribution<double> standard;
  return boost::math::quantile(standard, u);
}

}  // namespace slalom::sim
