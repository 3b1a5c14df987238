#include "slalom/sim/plant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/fakes.hpp"
#include "sim/reintegrate.hpp"

namespace slalom::sim {
namespace {

using testing::plan_of;
using vehicle::State;

ControlSignal wavy_signal() {
  planner::Request request;
  return ControlSignal(testing::wavy(request));  // from .5 s on, knots 2.3/9 s apart
}

TEST(ControlSignal, StraightOnIsZeroForAllTime) {
  const ControlSignal signal;
  for (const double t : {-1., 0., 7.}) EXPECT_EQ(signal.at(t), (vehicle::Control{0, 0}));
  EXPECT_TRUE(signal.knots().empty());
}

TEST(ControlSignal, LinearBetweenKnotsAtAbsoluteTimeAndHeldOutside) {
  planner::Request request;
  request.t0 = 3;
  request.t_start = 3.5;
  const ControlSignal signal(plan_of(
      request,
      [](double t) {
        return vehicle::Control{t * t, 1 - t};
      },
      2, 2));
  EXPECT_EQ(signal.knots(), (std::vector<double>{3.5, 4.5, 5.5}));
  EXPECT_EQ(signal.at(3.5), (vehicle::Control{0, 1}));
  EXPECT_DOUBLE_EQ(signal.at(3.75)[0], .25);  // between 0 and 1, not .0625
  EXPECT_DOUBLE_EQ(signal.at(5.)[0], 2.5);
  EXPECT_DOUBLE_EQ(signal.at(5.)[1], -.5);
  EXPECT_EQ(signal.at(5.5), (vehicle::Control{4, -1}));
  EXPECT_EQ(signal.at(50), (vehicle::Control{4, -1}));
  EXPECT_EQ(signal.at(0), (vehicle::Control{0, 1}));
}

TEST(ControlSignal, RefusesPlansThatCannotBeDriven) {
  const auto good = testing::straight_on({});
  EXPECT_TRUE(ControlSignal::usable(good));
  auto plan = good;
  plan.t.clear();
  EXPECT_FALSE(ControlSignal::usable(plan));
  EXPECT_THROW(ControlSignal{plan}, Error);
  plan = good;
  plan.controls.pop_back();
  EXPECT_FALSE(ControlSignal::usable(plan));
  plan = good;
  plan.controls[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ControlSignal::usable(plan));
  plan = good;
  std::swap(plan.t[2], plan.t[5]);
  EXPECT_FALSE(ControlSignal::usable(plan));
  plan = good;
  plan.t_start = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(ControlSignal::usable(plan));
}

TEST(Plant, StraightOnAtConstantSpeed) {
  const auto scenario = testing::open_field();
  const Plant plant(scenario.vehicle, 1e-9, .02);
  const State end = plant.predict(scenario.start, {}, 0, 3);
  EXPECT_NEAR(end[vehicle::X], 0, 1e-12);
  EXPECT_NEAR(end[vehicle::Y], 51, 1e-12);
  EXPECT_DOUBLE_EQ(end[vehicle::UX], 17);
}

TEST(Plant, AgreesWithAnIndependentIntegrator) {
  const Plant plant(vehicle::Parameters{}, 1e-9, .02);
  const auto signal = wavy_signal();
  const State start = {200, -40, .1, .05, 1.5, .03, 17, .2};
  const State end = plant.predict(start, signal, .5, 3.3);  // past the plan's end
  const State expected = testing::integrate_rk4(
      start, [&](double t) { return signal.at(t); },
      {.5, .5 + 2.3 / 9, .5 + 4.6 / 9, .5 + 6.9 / 9, .5 + 9.2 / 9, .5 + 11.5 / 9, .5 + 13.8 / 9,
       .5 + 16.1 / 9, .5 + 18.4 / 9, 2.8, 3.3});
  for (std::size_t i = 0; i < vehicle::kStates; ++i)
    EXPECT_NEAR(end[i], expected[i], 1e-8) << vehicle::kStateNames[i];
}

TEST(Plant, OneLongStretchIsAsAccurateAsManyShortOnes) {
  const Plant plant(vehicle::Parameters{}, 1e-9, .02);
  const State start = {0, 0, .1, .05, 1.5, .03, 17, .2};
  planner::Request request;
  request.t_start = 0;
  const ControlSignal signal(plan_of(
      request,
      [](double t) {
        return vehicle::Control{.05 * t, -t};
      },
      1, 1));
  const State once = plant.advance(start, signal, 0, 1);  // several adaptive steps
  const State often = plant.predict(start, signal, 0, 1);
  for (std::size_t i = 0; i < vehicle::kStates; ++i) EXPECT_NEAR(once[i], often[i], 1e-8);
}

TEST(Plant, DoesNotDependOnTheOrigin) {
  const Plant plant(vehicle::Parameters{}, 1e-9, .02);
  const auto signal = wavy_signal();
  State here = {0, 0, .1, .05, 1.5, .03, 17, .2}, there = here;
  there[vehicle::X] += 10000;
  there[vehicle::Y] -= 7000;
  here = plant.predict(here, signal, .5, 2.5);
  there = plant.predict(there, signal, .5, 2.5);
  EXPECT_NEAR(there[vehicle::X] - here[vehicle::X], 10000, 1e-9);
  EXPECT_NEAR(there[vehicle::Y] - here[vehicle::Y], -7000, 1e-9);
  for (const auto i : {vehicle::V, vehicle::R, vehicle::PSI, vehicle::UX})
    EXPECT_EQ(there[i], here[i]);
}

TEST(Plant, InstantsHoldEveryKnotAndNeverRepeat) {
  const Plant plant(vehicle::Parameters{}, 1e-9, .02);
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
  const Plant plant(vehicle::Parameters{}, 1e-9, .02);
  State lost = {0, 0, 2, .5, 1.5, .2, .5, -3};
  lost[vehicle::V] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plant.predict(lost, {}, 0, .5), PlantError);
}

// Slip angles' denominator ux + EP passes through zero: slow going, but numbers come out.
TEST(Plant, GoesThroughStandstill) {
  const Plant plant(vehicle::Parameters{}, 1e-9, .02);
  const State end = plant.predict({0, 0, .2, .05, 1.5, .02, .5, -3}, {}, 0, .5);
  EXPECT_NEAR(end[vehicle::UX], -1, 1e-9);
  EXPECT_TRUE(std::isfinite(end[vehicle::X]));
}

}  // namespace
}  // namespace slalom::sim
