#include "slalom/vehicle/control_signal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::vehicle {

bool ControlSignal::usable(const std::vector<double>& t, const std::vector<Control>& controls) {
  if (t.empty() || controls.size() != t.size() || !std::is_sorted(t.begin(), t.end())) return false;
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(t.begin(), t.end(), finite) &&
         std::all_of(controls.begin(), controls.end(), [&](const auto& control) {
           return std::all_of(control.begin(), control.end(), finite);
         });
}

ControlSignal::ControlSignal(std::vector<double> t, std::vector<Control> controls)
    : t_(std::move(t)), control_(std::move(controls)) {
  if (!usable(t_, control_)) throw Error("control signal: times and controls are not usable");
}

ControlSignal ControlSignal::delayed(double delay) const {
  ControlSignal result = *this;
  for (double& t : result.t_) t += delay;
  return result;
}

Control ControlSignal::at(double t) const {
  if (t_.empty()) return {};
  const auto next = std::upper_bound(t_.begin(), t_.end(), t);
  if (next == t_.begin()) return control_.front();
  if (next == t_.end()) return control_.back();
  const auto k = static_cast<std::size_t>(next - t_.begin());
  const double share = (t - t_[k - 1]) / (t_[k] - t_[k - 1]);
  Control result;
  for (std::size_t i = 0; i < kControls; ++i)
    result[i] = control_[k - 1][i] + share * (control_[k][i] - control_[k - 1][i]);
  return result;
}

}  // namespace slalom::vehicle
