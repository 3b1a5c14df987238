#include <gtest/gtest.h>

#include <cmath>

#include "../../src/paper/reproduction.hpp"

namespace slalom::paper {
namespace {

sim::PlantSample sample(double t, double sa, double sr, double jx) {
  sim::PlantSample s;
  s.t = t;
  s.state[vehicle::SA] = sa;
  s.control = {sr, jx};
  return s;
}

TEST(Effort, IsTenthOfTheIntegralOfTheSquare) {
  sim::Drive drive;
  drive.plant = {sample(0, .1, .2, 3), sample(2, .1, .2, 3)};
  const auto effort = effort_paper(drive);
  EXPECT_NEAR(effort.steering_angle, .1 * 2 * .01, 1e-15);
  EXPECT_NEAR(effort.steering_rate, .1 * 2 * .04, 1e-15);
  EXPECT_NEAR(effort.jerk, .1 * 2 * 9, 1e-14);
  EXPECT_NEAR(effort.total(), .1 * 2 * (.01 + .04 + 9), 1e-14);
}

TEST(Effort, IsExactForLinearControlsOnAnySamples) {
  // jx = 4 t - 1 over [0, 3]: the integral of its square is (11^3 + 1) / 12.
  sim::Drive drive;
  for (const double t : {0., .01, .5, .75, 2.9, 3.})
    drive.plant.push_back(sample(t, 0, 0, 4 * t - 1));
  EXPECT_NEAR(effort_paper(drive).jerk, .1 * (1331. + 1.) / 12., 1e-12);
}

TEST(Effort, SplitsAtJumps) {
  // 1 up to t = 1, then -2: a sample a nanosecond before the jump, as drives have it.
  sim::Drive drive;
  drive.plant = {sample(0, 0, 1, 0), sample(1 - 1e-9, 0, 1, 0), sample(1, 0, -2, 0),
                 sample(2, 0, -2, 0)};
  EXPECT_NEAR(effort_paper(drive).steering_rate, .1 * (1 + 4), 1e-8);
}

TEST(Effort, TakesTheCostsWeights) {
  sim::Drive drive;
  drive.plant = {sample(0, 1, 1, 1), sample(1, 1, 1, 1)};
  planner::Settings settings;
  settings.w_sa = 2;
  settings.w_sr = 3;
  settings.w_jx = 5;
  const auto effort = effort_weighted(drive, settings);
  EXPECT_DOUBLE_EQ(effort.steering_angle, 2);
  EXPECT_DOUBLE_EQ(effort.steering_rate, 3);
  EXPECT_DOUBLE_EQ(effort.jerk, 5);
}

TEST(Effort, OfNothingIsZero) {
  sim::Drive drive;
  EXPECT_EQ(effort_paper(drive).total(), 0);
  drive.plant = {sample(0, 1, 1, 1)};
  EXPECT_EQ(effort_paper(drive).total(), 0);
}

}  // namespace
}  // namespace slalom::paper
