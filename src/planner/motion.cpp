#include "motion.hpp"

#include <algorithm>
#include <cmath>

#include "../base/between_knots.hpp"

namespace slalom::planner {

vehicle::State Motion::state_at(double at) const {
  return between_knots(t, states, at);
}

vehicle::Control Motion::control_at(double at) const {
  return between_knots(t, controls, at);
}

void Motion::append(const Motion& other) {
  for (std::size_t k = 0; k < other.size(); ++k)
    add(other.t[k], other.states[k], other.controls[k]);
}

std::vector<world::Point> path_of(const Motion& motion) {
  constexpr std::size_t kMost = 60;
  std::vector<world::Point> path;
  const std::size_t every = 1 + motion.size() / kMost;
  path.reserve(kMost + 1);
  for (std::size_t k = 0; k < motion.size(); k += every)
    path.push_back({motion.states[k][vehicle::X], motion.states[k][vehicle::Y]});
  if (motion.size() > 0 && (motion.size() - 1) % every != 0)
    path.push_back({motion.states.back()[vehicle::X], motion.states.back()[vehicle::Y]});
  return path;
}

double apart(const vehicle::State& a, const vehicle::State& b) {
  return std::hypot(a[vehicle::X] - b[vehicle::X], a[vehicle::Y] - b[vehicle::Y]);
}

Motion part_before(const Motion& motion, double at) {
  Motion part;
  for (std::size_t k = 0; k < motion.size() && motion.t[k] < at - kSameTime; ++k)
    part.add(motion.t[k], motion.states[k], motion.controls[k]);
  return part;
}

Motion part_from(const Motion& motion, double t0, const vehicle::Plant& plant) {
  const auto next = static_cast<std::size_t>(
      std::upper_bound(motion.t.begin(), motion.t.end(), t0 + kSameTime) - motion.t.begin());
  Motion part;
  const vehicle::Control now = motion.control_at(t0);
  part.add(t0,
           plant.advance(motion.states[next - 1], motion.controls[next - 1], now,
                         motion.t[next - 1], t0),
           now);
  for (std::size_t k = next; k < motion.size(); ++k)
    part.add(motion.t[k], motion.states[k], motion.controls[k]);
  return part;
}

}  // namespace slalom::planner
