#include "motion.hpp"

#include "../base/between_knots.hpp"

namespace slalom::planner {

vehicle::State Motion::state_at(double at) const {
  return between_knots(t, states, at);
}

vehicle::Control Motion::control_at(double at) const {
  return between_knots(t, controls, at);
}

}  // namespace slalom::planner
