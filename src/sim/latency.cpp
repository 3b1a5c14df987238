#include "slalom/sim/latency.hpp"

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <random>

#include "slalom/base/error.hpp"

namespace slalom::sim {
namespace {

/// One lognormal draw a cycle, by inversion; each cycle has a generator of its own, so that a drive
/// that plans more often meets the same times.
double drawn(const LoopSettings& settings, int index) {
  if (settings.latency_spread == 0) return settings.latency_median;
  std::seed_seq mix{static_cast<std::uint32_t>(settings.latency_seed),
                    static_cast<std::uint32_t>(index)};
  std::mt19937_64 generator(mix);
  const double u = (static_cast<double>(generator() >> 11U) + 0.5) * 0x1p-53;
  const boost::math::normal_distribution<double> standard;
  return settings.latency_median *
         std::exp(settings.latency_spread * boost::math::quantile(standard, u));
}

}  // namespace

Latency::Latency(const LoopSettings& settings) : settings_(settings) {
  if (settings.latency == LatencyRule::recorded && settings.solve_times.empty())
    throw InvalidValue("loop.solve_times", "no solve times",
                       "a list or a file of them for latency: recorded");
}

double Latency::charge(int index, double measured) const {
  const auto& times = settings_.solve_times;
  switch (settings_.latency) {
    case LatencyRule::instant:
    case LatencyRule::paper:
      return 0;
    case LatencyRule::measured:
      return measured;
    case LatencyRule::recorded:
      return times[static_cast<std::size_t>(index - 1) % times.size()];
    case LatencyRule::model:
      return drawn(settings_, index);
  }
  return 0;
}

bool Latency::scripted() const {
  return settings_.latency == LatencyRule::recorded || settings_.latency == LatencyRule::model;
}

}  // namespace slalom::sim
