#include "draws.hpp"

#include <boost/math/distributions/normal.hpp>
#include <utility>

namespace slalom::sim {

double NormalDraws::next() {
  if (!generator_) {
    std::seed_seq mix(seed_.begin(), seed_.end());
    generator_.emplace(mix);
  }
  generator_->discard(std::exchange(skipped_, 0));
  const double u = (static_cast<double>((*generator_)() >> 11U) + 0.5) * 0x1p-53;
  const boost::math::normal_distribution<double> standard;
  return boost::math::quantile(standard, u);
}

}  // namespace slalom::sim
