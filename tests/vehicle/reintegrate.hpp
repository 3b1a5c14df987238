#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "slalom/vehicle/state.hpp"
#include "vehicle/reference_model.hpp"

namespace slalom::vehicle::testing {

/// Classical Runge–Kutta of order 4 with steps of at most `longest` [s] and the reference model:
/// another method, another step and another implementation of the model than the plant's.
/// `corners`: start, every kink or jump of the control, end.
template <class ControlAt>
State integrate_rk4(State x, const ControlAt& control_at, const std::vector<double>& corners,
                    bool asymmetric = true, double longest = 1e-3) {
  const reference::HMMWV model{asymmetric};
  const auto plus = [](const State& a, double h, const State& b) {
    State sum = a;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += h * b[i];
    return sum;
  };
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const double from = corners[k], length = corners[k + 1] - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(length / longest)));
    const double h = length / steps;
    // The control is linear between corners: its values there, from the inside.
    const double edge = std::min(1e-9, length / 4);
    const auto first = control_at(from + edge), last = control_at(from + length - edge);
    const auto control = [&](double t) {
      Control c;
      for (std::size_t i = 0; i < c.size(); ++i)
        c[i] = first[i] + (last[i] - first[i]) * (t / length);
      return c;
    };
    for (int n = 0; n < steps; ++n) {
      const double t = n * h;
      const auto k1 = model.derivative(x, control(t));
      const auto k2 = model.derivative(plus(x, h / 2, k1), control(t + h / 2));
      const auto k3 = model.derivative(plus(x, h / 2, k2), control(t + h / 2));
      const auto k4 = model.derivative(plus(x, h, k3), control(t + h));
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
  }
  return x;
}

}  // namespace slalom::vehicle::testing
