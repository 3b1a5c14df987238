#include "slalom/vehicle/plant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "vehicle/reintegrate.hpp"

namespace slalom::vehicle {
namespace {

/// Steers left and right and works the pedals: knots 2.3/9 s apart, from .5 s on.
ControlSignal wavy_signal() {
  std::vector<double> t;
  std::vector<Control> controls;
  for (int k = 0; k <= 9; ++k) {
    const double at = 2.3 * k / 9;
    t.push_back(.5 + at);
    controls.push_back({.08 * std::cos(2.1 * at), 2 * std::sin(5 * at)});
  }
  return {t, controls};
}

TEST(ControlSignal, StraightOnIsZeroForAllTime) {
  const ControlSignal signal;
  for (const double t : {-1., 0., 7.}) EXPECT_EQ(signal.at(t), (Control{0, 0}));
  EXPECT_TRUE(signal.knots().empty());
}

TEST(ControlSignal, LinearBetweenKnotsAtAbsoluteTimeAndHeldOutside) {
  const ControlSignal signal({3.5, 4.5, 5.5}, {{0, 1}, {1, 0}, {4, -1}});
  EXPECT_EQ(signal.knots(), (std::vector<double>{3.5, 4.5, 5.5}));
  EXPECT_EQ(signal.at(3.5), (Control{0, 1}));
  EXPECT_DOUBLE_EQ(signal.at(3.75)[0], .25);  // between 0 and 1, not .0625
  EXPECT_DOUBLE_EQ(signal.at(5.)[0], 2.5);
  EXPECT_DOUBLE_EQ(signal.at(5.)[1], -.5);
  EXPECT_EQ(signal.at(5.5), (Control{4, -1}));
  EXPECT_EQ(signal.at(50), (Control{4, -1}));
  EXPECT_EQ(signal.at(0), (Control{0, 1}));
}

TEST(Plant, StraightOnAtConstantSpeed) {
  Parameters symmetric;
  symmetric.tyre_asymmetry = false;
  const Plant plant(symmetric, 1e-9, .02);
  const State end = plant.predict({0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0}, {}, 0, 3);
  EXPECT_NEAR(end[X], 0, 1e-12);
  EXPECT_NEAR(end[Y], 51, 1e-12);
  EXPECT_DOUBLE_EQ(end[UX], 17);
}

TEST(Plant, AgreesWithAnIndependentIntegrator) {
  const Plant plant(Parameters{}, 1e-9, .02);
  const auto signal = wavy_signal();
  const State start = {200, -40, .1, .05, 1.5, .03, 17, .2};
  const State end = plant.predict(start, signal, .5, 3.3);  // past the plan's end
  const State expected = testing::integrate_rk4(
      start, [&](double t) { return signal.at(t); },
      {.5, .5 + 2.3 / 9, .5 + 4.6 / 9, .5 + 6.9 / 9, .5 + 9.2 / 9, .5 + 11.5 / 9, .5 + 13.8 / 9,
       .5 + 16.1 / 9, .5 + 18.4 / 9, 2.8, 3.3});
  for (std::size_t i = 0; i < kStates; ++i)
    EXPECT_NEAR(end[i], expected[i], 1e-8) << kStateNames[i];
}

/// To a creep and on, where the equations are stiff.
TEST(Plant, AgreesWithAnIndependentIntegratorAtACreep) {
  const Plant plant(Parameters{}, 1e-9, .02);
  const ControlSignal signal({0, .5, 1, 1.5, 2},
                             {{.02, -1}, {-.02, -.35}, {.01, .35}, {0, 1}, {0, 0}});
  const State start = {20, 5, 0, .02, 1.5, .03, .95, 0};
  const State end = plant.predict(start, signal, 0, 2.5);
  const State expected = testing::integrate_rk4(
      start, [&](double t) { return signal.at(t); }, {0, .5, 1, 1.5, 2, 2.5}, true, 2e-5);
  EXPECT_LT(end[UX], .8);
  for (std::size_t i = 0; i < kStates; ++i)
    EXPECT_NEAR(end[i], expected[i], 2e-8) << kStateNames[i];
}

TEST(Plant, OneLongStretchIsAsAccurateAsManyShortOnes) {
  const Plant plant(Parameters{}, 1e-9, .02);
  const State start = {0, 0, .1, .05, 1.5, .03, 17, .2};
  const ControlSignal signal({0, 1}, {{0, 0}, {.05, -1}});
  const State once = plant.advance(start, signal, 0, 1);  // several adaptive steps
  const State often = plant.predict(start, signal, 0, 1);
  for (std::size_t i = 0; i < kStates; ++i) EXPECT_NEAR(once[i], often[i], 1e-8);
}

TEST(Plant, DoesNotDependOnTheOrigin) {
  const Plant plant(Parameters{}, 1e-9, .02);
  const auto signal = wavy_signal();
  State here = {0, 0, .1, .05, 1.5, .03, 17, .2}, there = here;
  there[X] += 10000;
  there[Y] -= 7000;
  here = plant.predict(here, signal, .5, 2.5);
  there = plant.predict(there, signal, .5, 2.5);
  EXPECT_NEAR(there[X] - here[X], 10000, 1e-9);
  EXPECT_NEAR(there[Y] - here[Y], -7000, 1e-9);
  for (const auto i : {V, R, PSI, UX}) EXPECT_EQ(there[i], here[i]);
}

TEST(Plant, InstantsHoldEveryKnotAndNeverRepeat) {
  const Plant plant(Parameters{}, 1e-9, .02);
  const auto signal = wavy_signal();
  const auto instants = plant.instants(signal, .5, 1.5);
  EXPECT_EQ(instants.back(), 1.5);
  EXPECT_NEAR(instants[instants.size() - 2], 1.5 - 1e-9, 1e-12);
  double last = .5;
  for (const double t : instants) {
    EXPECT_GT(t, last);
    EXPECT_LE(t - last, .02 + 1e-12);
    last = t;
  }
  for (int k = 1; k <= 3; ++k)
    EXPECT_EQ(
        std::count(instants.begin(), instants.end(), signal.knots()[static_cast<std::size_t>(k)]),
        1);
}

TEST(Plant, SaysWhenTheModelEnds) {
  const Plant plant(Parameters{}, 1e-9, .02);
  State lost = {0, 0, 2, .5, 1.5, .2, .5, -3};
  lost[V] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plant.predict(lost, {}, 0, .5), PlantError);
}

// Slip angles' denominator ux + EP passes through zero: slow going, but numbers come out.
TEST(Plant, GoesThroughStandstill) {
  const Plant plant(Parameters{}, 1e-9, .02);
  const State end = plant.predict({0, 0, .2, .05, 1.5, .02, .5, -3}, {}, 0, .5);
  EXPECT_NEAR(end[UX], -1, 1e-9);
  EXPECT_TRUE(std::isfinite(end[X]));
}

}  // namespace
}  // namespace slalom::vehicle
