#include <gtest/gtest.h>

#include <cmath>

#include "slalom/vehicle/model.hpp"

namespace slalom::vehicle {
namespace {

/// A car of two equal axles, driven by the rear one.
Parameters car() {
  Parameters p;
  p.m = 1000;
  p.FzF0 = p.FzR0 = 5000;
  p.KZX = 200;
  p.PDX1 = 1;
  p.drive_front = 0;
  p.brake_front = 0.6;
  p.ax_max = {0, 0, 0, 12};
  p.ax_min = {0, 0, 0, -12};
  p.ux_max = 50;
  return p;
}

TEST(AccelerationLimits, PowerHoldsWhereItIsLess) {
  auto p = car();
  p.power = 60e3;  // 12 m/s^2 at 5 m/s
  EXPECT_NEAR(p.ax_max_at(30), 2, 0.01);
  EXPECT_NEAR(p.ax_max_at(0.5), 12, 0.01);
  EXPECT_EQ(p.ax_min_at(30), -12);
  for (double ux = 0; ux < 50; ux += 0.1) {
    EXPECT_LE(p.ax_max_at(ux), 12) << ux;
    EXPECT_LE(p.ax_max_at(ux) * ux * p.m, p.power) << ux;
  }
  // Smooth where the two cross, and no more than .1 m/s^2 below.
  EXPECT_GE(p.ax_max_at(5), 11.7);
}

/// Of the axle that has least left: driving, m ax = mu (FzR0 + KZX ax) at the rear one; braking,
/// .6 m d = mu (FzF0 + KZX d) in front and .4 m d = mu (FzR0 - KZX d) at the rear.
TEST(AccelerationLimits, FrictionHoldsOfTheAxleThatHasLeast) {
  auto p = car();
  p.friction_share = 0.8;
  EXPECT_NEAR(p.ax_max_at(10), 0.8 * 5000 / (1000 - 0.8 * 200), 0.01);
  EXPECT_NEAR(p.ax_min_at(10), -0.8 * 5000 / (400 + 0.8 * 200), 0.01);
  p.brake_front = 0.9;
  EXPECT_NEAR(p.ax_min_at(10), -0.8 * 5000 / (900 - 0.8 * 200), 0.01);
}

TEST(AccelerationLimits, ExpressionsAndNumbersAreOneLimit) {
  auto p = car();
  p.power = 60e3;
  p.friction_share = 0.8;
  const Model model = make_model(p);
  const expr::Function limits({model.state[UX]}, {}, {model.ax_min, model.ax_max});
  for (double ux = 0; ux < 50; ux += 0.7) {
    std::array<double, 2> values{};
    limits(std::array{ux}, {}, values);
    EXPECT_NEAR(values[0], p.ax_min_at(ux), 1e-13);
    EXPECT_NEAR(values[1], p.ax_max_at(ux), 1e-13);
  }
}

TEST(AccelerationLimits, AreTheCubicsAloneWhereNothingIsStated) {
  const Parameters p;
  EXPECT_EQ(p.ax_max_at(17),
            ((p.ax_max[0] * 17 + p.ax_max[1]) * 17 + p.ax_max[2]) * 17 + p.ax_max[3]);
  EXPECT_EQ(p.ax_min_at(17),
            ((p.ax_min[0] * 17 + p.ax_min[1]) * 17 + p.ax_min[2]) * 17 + p.ax_min[3]);
}

}  // namespace
}  // namespace slalom::vehicle
