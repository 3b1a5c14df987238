#include "../../src/planner/tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

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

/// Round a bend of radius 6 m from 5 m/s to a creep, as a way along a road has it.
world::Way stop_in_a_bend(double creep) {
  world::Way way;
  world::WayPoint w{0, 0, 0, 0, 5, 0, 0};
  for (; w.t < 5; w.t += 0.05) {
    w.a = w.v > creep ? std::max(-4., -2.5 * (w.v - creep)) : 0;
    w.kappa = std::min(w.t * 0.15, 1 / 6.);
    way.push_back(w);
    const double v = w.v + w.a * 0.05, turned = (w.v + v) / 2 * w.kappa * 0.05;
    w.x += (w.v + v) / 2 * 0.05 * std::cos(w.heading + turned / 2);
    w.y += (w.v + v) / 2 * 0.05 * std::sin(w.heading + turned / 2);
    w.heading += turned;
    w.v = v;
  }
  return way;
}

// Where it all but stands a vehicle cannot turn: it is not to drive on in order to.
TEST(Tracker, ABodyComesToStandInABendWhereItsReferenceDoes) {
  Parameters vehicle;
  vehicle.footprint = FootprintKind::rectangle;
  vehicle.sr_max_deg = 25;
  vehicle.sa_max_deg = 50;
  vehicle.jx_max = 20;
  vehicle.ax_min = {0, 0, 0, -8};
  const Plant plant(vehicle, 1e-9, 0.02);
  const Motion reference = reference_of(stop_in_a_bend(standing_of(vehicle, true).creep), vehicle);
  State start = reference.states[0];
  start[AX] = 0;
  start[PSI] += 0.03;
  const Motion motion = Tracker(vehicle, plant, true).follow(reference, start, 0, reference.end());
  EXPECT_LT(motion.states.back()[UX], 0.15);
  EXPECT_LT(apart(motion.states.back(), reference.states.back()), 0.8);
}

// A body settles as fast as its jerk allows, and nearer to standing than a point.
TEST(References, ABodyStopsShorterThanAPoint) {
  Driven d;
  const auto way_of = [&](FootprintKind kind) {
    Parameters vehicle = d.vehicle;
    vehicle.footprint = kind;
    vehicle.jx_max = 20;
    const Motion stop = braking_reference(d.reference, d.reference.states[0], 0, 3, vehicle, true);
    return std::pair(stop.states.back()[Y], stop.states.back()[UX]);
  };
  const auto [body, body_creep] = way_of(FootprintKind::rectangle);
  const auto [point, point_creep] = way_of(FootprintKind::point);
  EXPECT_LT(body, point - 1);
  EXPECT_LT(body_creep, point_creep - 0.02);
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
