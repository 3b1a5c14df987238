#include "slalom/vehicle/agility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "slalom/vehicle/model.hpp"

namespace slalom::vehicle {
namespace {

TEST(Agility, IsOneOfTheHmmwv) {
  const auto can = agility({});
  EXPECT_EQ(can.braking, 1);
  EXPECT_EQ(can.lateral, 1);
  EXPECT_EQ(can.curvature, 1);
  EXPECT_EQ(can.curvature_rate, 1);
}

TEST(Agility, FollowsFromTheLimits) {
  Parameters p;
  p.ax_min[3] *= 2;
  p.sr_max_deg *= 3;
  p.sa_max_deg = std::atan(0.5 * std::tan(p.sa_max())) * 180 / 3.14159265358979;
  auto can = agility(p);
  EXPECT_NEAR(can.braking, 2, 1e-12);
  EXPECT_NEAR(can.curvature_rate, 3, 1e-12);
  EXPECT_NEAR(can.curvature, 0.5, 1e-12);
  EXPECT_EQ(can.lateral, 1);
  // The HMMWV's rear wheels lift first, at (12696/2 - 1000)/1076 m/s^2; then its tyres slide.
  p.KZYR /= 10;
  can = agility(p);
  EXPECT_NEAR(can.lateral, 0.73957 * 9.80665 / ((12696 / 2. - 1000) / 1076), 1e-12);
}

// States and controls drawn from all that the limits allow, and beyond what tyres can hold.
TEST(Quickness, BoundsWhatTheModelDoes) {
  Parameters small;  // a car of a tenth of the size
  small.m /= 1000;
  small.Izz /= 1e5;
  small.la /= 10;
  small.lb /= 10;
  for (double* load : {&small.FzF0, &small.FzR0, &small.FZ0, &small.Fz_min, &small.F_offset_front,
                       &small.F_offset_rear})
    *load /= 1000;
  for (double* transfer : {&small.KZX, &small.KZYF, &small.KZYR}) *transfer /= 1000;
  std::mt19937 dice(7);
  for (const Parameters& p : {Parameters{}, small}) {
    const Quickness most = quickness(p);
    const Dynamics dynamics(p);
    double along = 0, across = 0, yaw = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto draw = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(dice);
      };
      const double ux = draw(p.ux_min, p.ux_max);
      const State x = {0,           0,
                       draw(-3, 3), draw(-0.6, 0.6),
                       0,           draw(-p.sa_max(), p.sa_max()),
                       ux,          draw(p.ax_min_at(ux), p.ax_max_at(ux))};
      const State rate = dynamics.derivative(x, {});
      along = std::max(along, std::fabs(x[AX]));
      across = std::max(across, std::fabs(rate[V] + x[UX] * x[R] + p.la * rate[R]));
      yaw = std::max(yaw, std::fabs(rate[R]));
    }
    EXPECT_LE(along, most.along);
    EXPECT_LE(across, most.across);
    EXPECT_LE(yaw, most.yaw);
    EXPECT_GT(across, most.across / 3) << "the bound says little";
    EXPECT_GT(yaw, most.yaw / 3);
  }
}

}  // namespace
}  // namespace slalom::vehicle
