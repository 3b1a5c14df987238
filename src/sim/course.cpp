#include "course.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::sim {

using vehicle::State;

Instant::Instant(double time, const State& at, const vehicle::Dynamics& dynamics)
    : t(time), state(at), loads(dynamics.wheel_loads(at)) {
  const State rate = dynamics.derivative(state, {});
  speed = std::hypot(rate[vehicle::X], rate[vehicle::Y]);
}

Course::Course(const Stretch& stretch, const vehicle::Dynamics& dynamics, const Instant& begin,
               const Instant& end)
    : stretch_(stretch), dynamics_(dynamics), begin_(begin), end_(end) {}

void Course::end_at(double t) {
  end_ = Instant(t, at(t), dynamics_);
}

State Course::at(double t) {
  return known(t).state;
}

vehicle::WheelLoads Course::loads(double t) {
  Known& found = known(t);
  if (!found.loads) found.loads = dynamics_.wheel_loads(found.state);
  return *found.loads;
}

double Course::fastest(const world::Footprint& footprint) const {
  const double speed = std::max({0.0, begin_.speed, end_.speed});
  const double turn =
      std::max(std::fabs(begin_.state[vehicle::R]), std::fabs(end_.state[vehicle::R]));
  return 1.1 * speed + 1 + (1.1 * turn + 2) * footprint.reach();
}

Course::Known& Course::known(double t) {
  const auto found =
      std::find_if(known_.begin(), known_.end(), [t](const Known& k) { return k.t == t; });
  if (found != known_.end()) return *found;
  return known_.emplace_back(Known{t, stretch_.at(t), {}});
}

}  // namespace slalom::sim
