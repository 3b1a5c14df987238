#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "slalom/vehicle/control_signal.hpp"
#include "slalom/vehicle/plant.hpp"

namespace slalom::sim {

/// The last prediction, instant by instant. A plant of the vehicle that was believed in, which goes
/// on from the same state by the same controls for the same time, gets to the same state: most
/// often the plant drives just what was predicted, and need not be integrated again.
class Rehearsal {
 public:
  /// Another prediction begins.
  void begin_anew();
  /// As Plant::predict, whose steps it remembers. Throws PlantError.
  vehicle::State predict(const vehicle::Plant& plant, vehicle::State state,
                         const vehicle::ControlSignal& signal, double t0, double t1);
  /// Where `state` at t0 gets by t1 on `signal`, if that was a step of the prediction, to the bits.
  std::optional<vehicle::State> end_of(const vehicle::State& state,
                                       const vehicle::ControlSignal& signal, double t0, double t1);

 private:
  struct Step {
    double t0, t1;
    vehicle::State from;
    vehicle::Control first, last;
    vehicle::State to;
  };
  std::vector<Step> steps_;
  std::size_t next_ = 0;  ///< the step that is asked for next, as a rule
};

}  // namespace slalom::sim
