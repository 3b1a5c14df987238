#include "slalom/vehicle/control_signal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../base/between_knots.hpp"
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
  return t_.empty() ? Control{} : between_knots(t_, control_, t);
}

}  // namespace slalom::vehicle
