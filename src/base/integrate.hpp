#pragma once

// Needs Boost's headers (odeint).

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_step_result.hpp>
#include <cmath>

namespace slalom {

/// Attempts an integration may take before the state counts as lost.
inline constexpr int kMostIntegrationSteps = 20000;

/// Integrates x' = f by a controlled stepper of odeint from t = 0 to `length`, the first step tried
/// being the whole; a step into NaN or infinity is tried again with a quarter of it. rhs(x, x', t)
/// sets x'. False when the end is out of reach, in so many attempts or by steps below `least_step`;
/// x and t are then where it stuck.
template <class Stepper, class Rhs, class State>
bool integrate(Stepper stepper, const Rhs& rhs, double length, double least_step, State& x,
               double& t) {
  double step = length;
  t = 0;
  for (int attempt = 0; attempt < kMostIntegrationSteps; ++attempt) {
    const bool reaches_end = step >= length - t;
    step = std::min(step, length - t);
    const State before = x;
    const double t_before = t, tried = step;
    const auto result = stepper.try_step(rhs, x, t, step);
    if (!std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); })) {
      x = before;
      t = t_before;
      step = tried / 4;
    } else if (result == boost::numeric::odeint::success && reaches_end) {
      return true;
    }
    if (step < least_step) return false;
  }
  return false;
}

}  // namespace slalom
