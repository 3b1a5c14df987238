#include "slalom/vehicle/agility.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace slalom::vehicle
