// What the loop plans from, against what it drives.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/fakes.hpp"
#include "slalom/base/error.hpp"
#include "slalom/sim/closed_loop.hpp"
#include "slalom/vehicle/plant.hpp"

namespace slalom::sim {
namespace {

using vehicle::ControlSignal;
using vehicle::Plant;

using testing::open_field;
using vehicle::Control;
using vehicle::State;

Scenario field() {
  auto s = open_field();
  s.vehicle.tyre_asymmetry = true;
  s.loop.timeout = 3;
  return s;
}

/// The drive, and what its planner was asked.
struct Driven {
  std::vector<planner::Request> asked;
  Drive drive;
};

Driven driven(const Scenario& s, const PlanFunction& plan = testing::wavy) {
  Driven result;
  result.drive = drive(s, [&](const planner::Request& request) {
    result.asked.push_back(request);
    return plan(request);
  });
  return result;
}

const PlantSample& sample_at(const Drive& d, double t) {
  return *std::min_element(d.plant.begin(), d.plant.end(), [t](const auto& a, const auto& b) {
    return std::abs(a.t - t) < std::abs(b.t - t);
  });
}

void expect_near(const State& a, const State& b, double tolerance) {
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

/// Samples, advanced one by one by `plant`, give each other.
void expect_driven_by(const Plant& plant, const Drive& d) {
  for (std::size_t i = 0; i + 1 < d.plant.size(); ++i) {
    const auto &a = d.plant[i], &b = d.plant[i + 1];
    if (b.t - a.t < 1e-6) continue;  // a jump of the control
    planner::Plan line;
    line.t = {a.t, b.t};
    line.controls = {a.control, b.control};
    line.states = {a.state, b.state};
    expect_near(plant.advance(a.state, control_signal(line), a.t, b.t), b.state, 1e-8);
  }
}

TEST(Belief, ThePlantIsDrivenAndTheVehiclePredicted) {
  auto s = field();
  s.plant.mass_factor = 1.4;
  s.plant.cornering_stiffness_factor = 0.6;
  const auto [asked, d] = driven(s);
  ASSERT_EQ(d.outcome, Outcome::timeout) << d.message;
  expect_driven_by(Plant(plant_vehicle(s.vehicle, s.plant, "test"), 1e-9, 0.02), d);

  const Plant believed(s.vehicle, s.loop.plant_tolerance, s.loop.sample_step);
  ControlSignal signal;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const auto& start = sample_at(d, asked[k].t0).state;
    EXPECT_EQ(asked[k].X0p, believed.predict(start, signal, asked[k].t0, asked[k].t0 + 0.5));
    signal = control_signal(d.cycles[k].plan);
  }
  // And that is not where the plant arrives.
  const auto &last = d.cycles.back(), &before = d.cycles[d.cycles.size() - 2];
  EXPECT_GT(std::abs(before.X0p[vehicle::R] - sample_at(d, last.t0).state[vehicle::R]), 1e-4);
  // Wheel loads are the plant's.
  EXPECT_NEAR(d.plant.front().wheel_loads[vehicle::RL], 1.4 * s.vehicle.FzR0 / 2, 20);
}

TEST(Belief, ADelayedPlantDrivesWhatWasCommandedThatMuchEarlier) {
  for (const double delay : {0.13, 0.5, 0.81}) {
    auto s = field();
    s.plant.actuator_delay = delay;
    const auto [asked, d] = driven(s);
    const auto commanded = [&, &cycles = d.cycles](double t) {
      Control control{};
      for (const auto& cycle : cycles)
        if (cycle.used && cycle.plan.t_start <= t) control = control_signal(cycle.plan).at(t);
      return control;
    };
    int compared = 0;
    for (const auto& sample : d.plant) {
      const double t = sample.t - delay, into = t / 0.5 - std::floor(t / 0.5);
      if (into < 1e-6 || into > 1 - 1e-6) continue;  // at a jump
      const Control expected = commanded(t);
      for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(sample.control[i], expected[i], 1e-9) << t;
      ++compared;
    }
    EXPECT_GT(compared, 140);
    expect_driven_by(Plant(s.vehicle, 1e-9, 0.02), d);
    // Prediction takes the command for driven.
    const Plant believed(s.vehicle, s.loop.plant_tolerance, s.loop.sample_step);
    const auto& start = sample_at(d, asked[2].t0).state;
    EXPECT_EQ(asked[2].X0p, believed.predict(start, control_signal(d.cycles[1].plan), 1, 1.5));
  }
}

TEST(Belief, ThePlannerIsToldAnOlderState) {
  for (const double delay : {0.1, 0.113, 0.7}) {  // on a sample, between two, over a horizon
    auto s = field();
    s.loop.latency = LatencyRule::instant;
    const auto age = delay;
    s.sensing.delay = delay;
    s.plant.actuator_delay = 0.2;
    const auto [asked, d] = driven(s);
    EXPECT_EQ(asked[0].X0p, s.start);
    for (const auto& request : asked) {
      const double t = request.t0 - age;
      if (t < 0) continue;
      // The same state between the samples on either side, by the plant itself.
      const auto later = std::find_if(d.plant.begin(), d.plant.end(),
                                      [&](const auto& p) { return p.t > t + 1e-12; });
      const auto &a = *(later - 1), &b = *later;
      planner::Plan line;
      line.t = {a.t, b.t};
      line.controls = {a.control, b.control};
      line.states = {a.state, b.state};
      const State then =
          Plant(s.vehicle, 1e-9, 0.02).advance(a.state, control_signal(line), a.t, t);
      expect_near(request.X0p, then, 1e-8);
    }
  }
}

TEST(Belief, NoiseIsOnWhatThePlannerIsToldAlone) {
  auto s = field();
  s.loop.latency = LatencyRule::instant;
  s.sensing.position_noise = 0.2;
  s.sensing.noise_seed = 5;
  const auto told = driven(s, testing::straight_on), again = driven(s, testing::straight_on);
  s.sensing = {};
  const auto exact = driven(s, testing::straight_on);
  const Sensors sensors({.position_noise = 0.2, .noise_seed = 5}, 0);
  for (std::size_t k = 0; k < told.asked.size(); ++k) {
    EXPECT_EQ(told.asked[k].X0p, sensors.measured(exact.asked[k].X0p, static_cast<int>(k) + 1));
    EXPECT_EQ(told.asked[k].X0p, again.asked[k].X0p);
  }
  ASSERT_EQ(told.drive.plant.size(), exact.drive.plant.size());
  EXPECT_EQ(told.drive.plant.back().state, exact.drive.plant.back().state);
}

TEST(Belief, ObstaclesHitWhereTheyAreAndArePlannedForWhereTheyAreBelieved) {
  auto s = field();
  s.obstacles = {testing::circle("O1", 30, 40, 2, -12, 0)};
  const auto told = driven(s, testing::straight_on);
  EXPECT_FALSE(told.asked.front().obstacles);
  s.sensing.obstacle_velocity_factor = 0;
  const auto blind = driven(s, testing::straight_on);
  EXPECT_EQ(blind.drive.outcome, Outcome::crash);
  EXPECT_EQ(blind.drive.time, told.drive.time);
  for (const auto& request : blind.asked) {
    ASSERT_EQ(request.obstacles->size(), 1u);
    EXPECT_EQ(request.obstacles->front().vx, 0);
    EXPECT_DOUBLE_EQ(request.obstacles->front().x_at(99), 30 - 12 * request.t0);
  }
}

TEST(Belief, KnownDelaysAreCompensatedByPrediction) {
  for (const double sensing : {0., 0.13})
    for (const double actuator : {0., 0.21, 0.7}) {
      auto s = field();
      s.sensing.delay = sensing;
      s.plant.actuator_delay = actuator;
      s.loop.compensate_delay = true;
      const auto told = driven(s);
      ASSERT_GE(told.asked.size(), 5u);
      for (std::size_t k = 0; k < 4; ++k) {
        const auto& request = told.asked[k];
        EXPECT_DOUBLE_EQ(request.t_start, request.t0 + s.loop.tex + actuator);
        if (request.t_start > s.loop.timeout) continue;
        // The state that it plans from is the one that the vehicle is in when the plan acts.
        const auto& sample = sample_at(told.drive, request.t_start);
        ASSERT_NEAR(sample.t, request.t_start, 1e-6);
        expect_near(request.X0p, sample.state, 1e-5);
      }
    }
}

TEST(Belief, BadSettingsAreRefused) {
  const auto refused = [](const auto& change) {
    auto s = field();
    change(s);
    EXPECT_THROW(check(s, "test"), InvalidValue);
  };
  refused([](Scenario& s) { s.plant.mass_factor = -1; });
  refused([](Scenario& s) { s.plant.cg_shift = 2; });
  refused([](Scenario& s) { s.sensing.delay = -1; });
  refused([](Scenario& s) { s.sensing.obstacle_velocity_factor = std::nan(""); });
  // So light that a wheel is off the ground at the start.
  refused([](Scenario& s) {
    s.plant.mass_factor = 0.1;
    s.loop.Fz_failure = 1000;
  });
}

}  // namespace
}  // namespace slalom::sim
