#include "slalom/sim/latency.hpp"

#include <cmath>
#include <cstdint>

#include "draws.hpp"
#include "slalom/base/error.hpp"

namespace slalom::sim {
namespace {

/// One lognormal draw a cycle; each cycle has a generator of its own, so that a drive that plans
/// more often meets the same times.
double drawn(const LoopSettings& settings, int index) {
  if (settings.latency_spread == 0) return settings.latency_median;
  NormalDraws draws{static_cast<std::uint32_t>(settings.latency_seed),
                    static_cast<std::uint32_t>(index)};
  return settings.latency_median * std::exp(settings.latency_spread * draws.next());
}

}  // namespace

Latency::Latency(const LoopSettings& settings) : settings_(settings) {
  if (settings.latency == LatencyRule::recorded && settings.solve_times.empty())
    throw InvalidValue("loop.solve_times", "no solve times",
                       "a list or a file of them for latency: recorded",
                       {"latency", "solve_times"});
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
