#include "../../src/planner/tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../src/planner/references.hpp"
#include "vehicle/reintegrate.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// A bend of .02/m at 12 m/s that comes and goes over 2 s, from (0, 0) northwards.
world::Way bend() {
  world::Way way;
  world::WayPoint w{0, 0, 0, std::numbers::pi / 2, 12, 0, 0};
  for (; w.t < 8; w.t += 0.05) {
    way.push_back(w);
    w.kappa = 0.02 * std::clamp(std::min(w.t - 1, 6 - w.t) / 2, 0., 1.);
    const double turned = w.v * w.kappa * 0.05;
    w.x += w.v * 0.05 * std::cos(w.heading + turned / 2);
    w.y += w.v * 0.05 * std::sin(w.heading + turned / 2);
    w.heading += turned;
  }
  return way;
}

struct Driven {
  Parameters vehicle;
  Plant plant{vehicle, 1e-9, 0.02};
  Tracker tracker{vehicle, plant};
  Motion reference = reference_of(bend(), vehicle);
};

double off(const Motion& reference, const Motion& motion, double from = 0) {
  double most = 0;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    if (motion.t[k] < from) continue;
    const State r = reference.state_at(motion.t[k]);
    most = std::max(most, std::hypot(motion.states[k][X] - r[X], motion.states[k][Y] - r[Y]));
  }
  return most;
}

TEST(Tracker, StaysOnAWay) {
  Driven d;
  const Motion motion = d.tracker.follow(d.reference, d.reference.states[0], 0, d.reference.end());
  EXPECT_NEAR(motion.end(), d.reference.end(), 1e-12);
  EXPECT_LT(off(d.reference, motion), 0.4);
}

TEST(Tracker, ComesBackToIt) {
  Driven d;
  State beside = d.reference.states[0];
  beside[X] += 1;
  beside[PSI] += 0.03;
  const Motion motion = d.tracker.follow(d.reference, beside, 0, d.reference.end());
  EXPECT_LT(off(d.reference, motion, 4), 0.4);
}

TEST(Tracker, WhatItGivesIsAMotionOfThePlant) {
  Driven d;
  const Motion motion = d.tracker.follow(d.reference, d.reference.states[0], 0, 3);
  const State end = testing::integrate_rk4(
      motion.states[0], [&](double t) { return motion.control_at(t); }, motion.t);
  for (std::size_t i = 0; i < kStates; ++i) EXPECT_NEAR(end[i], motion.states.back()[i], 1e-7);
}

TEST(Tracker, KeepsTheControlsLimitsWhateverTheReference) {
  Driven d;
  Motion wild = d.reference;
  for (std::size_t k = 0; k < wild.size(); ++k) wild.states[k][X] += k % 40 < 20 ? 6 : -6;
  const Motion motion = d.tracker.follow(wild, wild.states[0], 0, wild.end());
  double steering = 0;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const State& x = motion.states[k];
    steering = std::max(steering, std::fabs(motion.controls[k][SR]));
    EXPECT_LE(std::fabs(motion.controls[k][SR]), d.vehicle.sr_max());
    EXPECT_LE(std::fabs(motion.controls[k][JX]), d.vehicle.jx_max);
    EXPECT_LE(std::fabs(x[SA]), d.vehicle.sa_max());
    EXPECT_LE(x[AX], d.vehicle.ax_max_at(x[UX]) + 0.1);
    EXPECT_GE(x[AX], d.vehicle.ax_min_at(x[UX]) - 0.1);
  }
  EXPECT_GT(steering, 0.9 * d.vehicle.sr_max()) << "the reference asks for all there is";
}

TEST(Tracker, WithoutTimeToGoItStaysWithoutControl) {
  Driven d;
  const State& X0 = d.reference.states[3];
  const Motion motion = d.tracker.follow(d.reference, X0, 1, 1);
  ASSERT_EQ(motion.size(), 1U);
  EXPECT_EQ(motion.states[0], X0);
  EXPECT_EQ(motion.controls[0], (Control{0, 0}));
}

TEST(References, BrakeToACreepAlongThePath) {
  Driven d;
  const Motion stop = braking_reference(d.reference, d.reference.states[0], 0, 3, d.vehicle);
  EXPECT_LT(stop.states.back()[UX], 0.2);
  EXPECT_NEAR(stop.states.back()[Y], 12 * 12 / (2 * 3) + 0.9 * 12, 12)
      << "v^2/2a, and the jerk's time";
  const Motion motion = d.tracker.follow(stop, stop.states[0], 0, stop.end());
  EXPECT_LT(motion.states.back()[UX], 0.3);
  EXPECT_LT(off(stop, motion), 0.5);
}

TEST(References, SwervesMirrorEachOther) {
  Driven d;
  const State start = {0, 0, 0, 0, std::numbers::pi / 2, 0, 15, 0};
  const Motion left = swerve_reference(start, 0, 1, d.vehicle);
  const Motion right = swerve_reference(start, 0, -1, d.vehicle);
  EXPECT_LT(left.states.back()[X], -1);
  EXPECT_NEAR(left.states.back()[X], -right.states.back()[X], 1e-9);
}

}  // namespace
}  // namespace slalom::planner
