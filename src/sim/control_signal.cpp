#include "slalom/sim/control_signal.hpp"

#include <algorithm>
#include <cmath>

#include "slalom/base/error.hpp"

namespace slalom::sim {

bool ControlSignal::usable(const planner::Plan& plan) {
  if (plan.t.empty() || plan.controls.size() != plan.t.size()) return false;
  if (!std::isfinite(plan.t_start) || !std::is_sorted(plan.t.begin(), plan.t.end())) return false;
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(plan.t.begin(), plan.t.end(), finite) &&
         std::all_of(plan.controls.begin(), plan.controls.end(), [&](const auto& control) {
           return std::all_of(control.begin(), control.end(), finite);
         });
}

ControlSignal::ControlSignal(const planner::Plan& plan) : control_(plan.controls) {
  if (!usable(plan)) throw Error("control signal: the plan has no usable controls");
  t_.reserve(plan.t.size());
  for (const double t : plan.t) t_.push_back(plan.t_start + t);
}

ControlSignal ControlSignal::delayed(double delay) const {
  ControlSignal result = *this;
  for (double& t : result.t_) t += delay;
  return result;
}

vehicle::Control ControlSignal::at(double t) const {
  if (t_.empty()) return {};
  const auto next = std::upper_bound(t_.begin(), t_.end(), t);
  if (next == t_.begin()) return control_.front();
  if (next == t_.end()) return control_.back();
  const auto k = static_cast<std::size_t>(next - t_.begin());
  const double share = (t - t_[k - 1]) / (t_[k] - t_[k - 1]);
  vehicle::Control result;
  for (std::size_t i = 0; i < vehicle::kControls; ++i)
    result[i] = control_[k - 1][i] + share * (control_[k][i] - control_[k - 1][i]);
  return result;
}

}  // namespace slalom::sim
