#include "slalom/sim/actuator.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace slalom::sim {

void Actuator::command(vehicle::ControlSignal signal, double t) {
  driven_.push_back({t + delay_, signal.delayed(delay_)});
  commanded_ = std::move(signal);
}

std::size_t Actuator::in_force(double t) const {
  const auto next = std::upper_bound(driven_.begin(), driven_.end(), t,
                                     [](double at, const Driven& d) { return at < d.from; });
  return static_cast<std::size_t>(next - driven_.begin());
}

const vehicle::ControlSignal& Actuator::driven(double t) const {
  const std::size_t count = in_force(t);
  return count == 0 ? straight_on_ : driven_[count - 1].signal;
}

double Actuator::next_change(double t) const {
  const std::size_t count = in_force(t);
  return count == driven_.size() ? std::numeric_limits<double>::infinity() : driven_[count].from;
}

}  // namespace slalom::sim
