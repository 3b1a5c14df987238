#include "slalom/sim/actuator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/fakes.hpp"

namespace slalom::sim {
namespace {

using vehicle::ControlSignal;

using vehicle::Control;

/// A plan from t on whose jerk is `jerk` + t.
ControlSignal ramp(double t, double jerk) {
  planner::Request request;
  request.t0 = t;
  request.t_start = t;
  return control_signal(testing::plan_of(
      request,
      [jerk](double at) {
        return Control{0.01 * jerk, jerk + at};
      },
      1, 4));
}

TEST(Actuator, WithoutDelayWhatIsCommandedIsDriven) {
  Actuator actuator(0);
  EXPECT_EQ(actuator.driven(3).at(3), Control{});
  const auto signal = ramp(0.3, 2);
  actuator.command(signal, 0.3);
  EXPECT_EQ(actuator.driven(0.29).at(0.29), Control{});
  for (double t = 0.3; t < 2; t += 0.07) EXPECT_EQ(actuator.driven(t).at(t), signal.at(t));
  EXPECT_EQ(actuator.driven(0.3).knots(), signal.knots());
}

TEST(Actuator, ADelayLongerThanSignalsLastKeepsTheirOrder) {
  const double delay = 0.7;
  Actuator actuator(delay);
  std::vector<ControlSignal> signals;
  for (int k = 0; k < 4; ++k) {
    signals.push_back(ramp(0.5 * k, 10. * (k + 1)));
    actuator.command(signals.back(), 0.5 * k);
    EXPECT_EQ(actuator.commanded().at(0.5 * k), signals.back().at(0.5 * k));
  }
  for (double t = 0.01; t < 3; t += 0.03) {
    const double commanded_at = t - delay;
    const auto k = static_cast<std::size_t>(std::max(0., std::floor(commanded_at / 0.5)));
    const auto expected =
        commanded_at < 0 ? Control{} : signals[std::min<std::size_t>(k, 3)].at(commanded_at);
    const auto driven = actuator.driven(t).at(t);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(driven[i], expected[i], 1e-12) << t;
  }
  EXPECT_DOUBLE_EQ(actuator.next_change(0), 0.7);
  EXPECT_DOUBLE_EQ(actuator.next_change(0.7), 1.2);
  EXPECT_DOUBLE_EQ(actuator.next_change(1.3), 1.7);
  EXPECT_EQ(actuator.next_change(2.2), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace slalom::sim
