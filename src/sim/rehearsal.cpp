#include "rehearsal.hpp"

#include "../base/same_bits.hpp"

namespace slalom::sim {
void Rehearsal::begin_anew() {
  steps_.clear();
  next_ = 0;
}

vehicle::State Rehearsal::predict(const vehicle::Plant& plant, vehicle::State state,
                                  const vehicle::ControlSignal& signal, double t0, double t1) {
  for (const double t : plant.instants(signal, t0, t1)) {
    Step step{t0, t, state, signal.at(t0), signal.at(t), {}};
    step.to = state = plant.advance(state, step.first, step.last, t0, t);
    steps_.push_back(step);
    t0 = t;
  }
  return state;
}

std::optional<vehicle::State> Rehearsal::end_of(const vehicle::State& state,
                                                const vehicle::ControlSignal& signal, double t0,
                                                double t1) {
  // A plant that drives something else asks in vain, but soon.
  if (next_ == steps_.size()) return std::nullopt;
  const Step& step = steps_[next_];
  if (step.t0 != t0 || step.t1 != t1 || !same_bits(step.from, state) ||
      !same_bits(step.first, signal.at(t0)) || !same_bits(step.last, signal.at(t1)))
    return std::nullopt;
  ++next_;
  return step.to;
}

}  // namespace slalom::sim
