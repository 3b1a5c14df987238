#include "slalom/sim/sensing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "sim/fakes.hpp"

namespace slalom::sim {
namespace {

using vehicle::State;

const State kState = {200, 8.5, 0.3, 0.1, 1.5, 0.05, 17, 0.2};

/// Every noise there is.
SensingSettings noisy() {
  SensingSettings s;
  s.position_noise = 0.3;
  s.heading_noise = 0.02;
  s.speed_noise = 0.5;
  s.yaw_rate_noise = 0.04;
  s.obstacle_position_noise = 0.7;
  return s;
}

TEST(Sensors, DefaultsTellTheTruthToTheBit) {
  const Sensors sensors({}, 0);
  EXPECT_EQ(sensors.measured(kState, 3), kState);
  EXPECT_FALSE(sensors.believed({testing::circle("O1", 1, 2, 3, 4, 5)}, 3, 2));
}

TEST(Sensors, NoiseHasNoBiasAndTheDeviationAskedFor) {
  const Sensors sensors(noisy(), 0);
  const std::array<double, vehicle::kStates> sigma = {0.3, 0.3, 0.5, 0.04, 0.02, 0, 0.5, 0};
  constexpr int kCycles = 4000;
  State mean{}, square{};
  for (int k = 0; k < kCycles; ++k) {
    const State told = sensors.measured(kState, k);
    for (std::size_t i = 0; i < told.size(); ++i) {
      mean[i] += (told[i] - kState[i]) / kCycles;
      square[i] += (told[i] - kState[i]) * (told[i] - kState[i]) / kCycles;
    }
  }
  for (std::size_t i = 0; i < sigma.size(); ++i) {  // five standard errors
    EXPECT_NEAR(mean[i], 0, 5 * sigma[i] / std::sqrt(kCycles)) << i;
    EXPECT_NEAR(square[i], sigma[i] * sigma[i], 5 * sigma[i] * sigma[i] * std::sqrt(2. / kCycles))
        << i;
  }
}

TEST(Sensors, ACyclesNoiseIsItsOwnAndTheSeeds) {
  auto settings = noisy();
  const State told = Sensors(settings, 0).measured(kState, 7);
  EXPECT_EQ(Sensors(settings, 0).measured(kState, 7), told);
  EXPECT_NE(Sensors(settings, 0).measured(kState, 8), told);
  // x and y, and ux and v, have draws of their own.
  EXPECT_NE(told[vehicle::X] - kState[vehicle::X], told[vehicle::Y] - kState[vehicle::Y]);
  EXPECT_NE(told[vehicle::UX] - kState[vehicle::UX], told[vehicle::V] - kState[vehicle::V]);
  // Without the noise of position the others stay as they are.
  auto quieter = settings;
  quieter.position_noise = 0;
  const State less = Sensors(quieter, 0).measured(kState, 7);
  EXPECT_EQ(less[vehicle::X], kState[vehicle::X]);
  EXPECT_EQ(less[vehicle::R], told[vehicle::R]);
  settings.noise_seed = 1;
  EXPECT_NE(Sensors(settings, 0).measured(kState, 7), told);
}

TEST(Sensors, TheLateralSpeedIsThatOfTheBelievedCentreOfGravity) {
  const double shift = 0.4;
  const State told = Sensors({}, shift).measured(kState, 1);
  // The front axle's centre, la ahead of the one and la - shift of the other, moves as it does.
  const double la = 1.5775;
  EXPECT_DOUBLE_EQ(told[vehicle::V] + la * told[vehicle::R],
                   kState[vehicle::V] + (la - shift) * kState[vehicle::R]);
}

TEST(Sensors, ObstaclesStandWhereTheyAreAndErrFromThereOn) {
  SensingSettings settings;
  settings.obstacle_velocity_factor = 0.7;
  const std::vector<world::Obstacle> real = {testing::circle("O1", 10, 20, 3, -2, 5),
                                             testing::circle("cone", 1, 2, 0.5)};
  const double t0 = 6.5;
  const auto believed = Sensors(settings, 0).believed(real, 2, t0).value();
  ASSERT_EQ(believed.size(), 2u);
  EXPECT_EQ(believed[0].name, "O1");
  EXPECT_EQ(believed[0].a, 3);
  for (const double h : {0., 0.5, 4.}) {
    EXPECT_NEAR(believed[0].x_at(t0 + h) - real[0].x_at(t0 + h), -0.3 * -2 * h, 1e-12);
    EXPECT_NEAR(believed[0].y_at(t0 + h) - real[0].y_at(t0 + h), -0.3 * 5 * h, 1e-12);
    EXPECT_EQ(believed[1].x_at(t0 + h), 1);
    EXPECT_EQ(believed[1].y_at(t0 + h), 2);
  }
}

TEST(Sensors, ObstaclesHaveNoiseOfTheirOwn) {
  const Sensors sensors(noisy(), 0);
  const std::vector<world::Obstacle> real(3, testing::circle("O", 10, 20, 3));
  double square = 0;
  constexpr int kCycles = 1000;
  for (int k = 0; k < kCycles; ++k) {
    const auto told = sensors.believed(real, k, 0).value();
    EXPECT_NE(told[0].x, told[1].x);
    EXPECT_NE(told[1].x, told[2].x);
    for (const auto& o : told)
      square += ((o.x - 10) * (o.x - 10) + (o.y - 20) * (o.y - 20)) / (6. * kCycles);
  }
  EXPECT_NEAR(square, 0.49, 5 * 0.49 * std::sqrt(2 / (6. * kCycles)));
}

TEST(Sensors, AMotionByATableIsGoneThroughFasterFromWhereItIs) {
  SensingSettings settings;
  settings.obstacle_velocity_factor = 1.5;
  auto car = testing::circle("car", 0, 0, 1);
  const auto rows = std::vector<world::TrajectoryRow>{
      {0, 0, 0, 0}, {1, 4, 0, 0.2}, {2, 7, 2, 0.6}, {5, 7, 12, 1.6}};
  const auto table = std::make_shared<world::TableTrajectory>(rows, world::BeyondEnd::stands,
                                                              world::BeyondEnd::absent, "car");
  car.trajectory = table;
  const double t0 = 1.2;
  const auto believed = Sensors(settings, 0).believed({car}, 2, t0).value()[0];
  for (const double h : {0., 0.4, 1.5, 2.5}) {
    const auto pose = believed.pose_at(t0 + h), real = table->at(t0 + 1.5 * h);
    EXPECT_NEAR(pose.x, real.x, 1e-12);
    EXPECT_NEAR(pose.psi, real.psi, 1e-12);
    EXPECT_NEAR(pose.vy, 1.5 * real.vy, 1e-12);
    EXPECT_NEAR(pose.omega, 1.5 * real.omega, 1e-12);
    EXPECT_LE(std::hypot(pose.vx, pose.vy), believed.trajectory->fastest(t0, t0 + h).speed + 1e-12);
  }
  // It is gone that much sooner, too.
  EXPECT_TRUE(believed.present(3.7, 3.7));
  EXPECT_FALSE(believed.present(3.8, 3.8));
  settings = {};
  settings.obstacle_position_noise = 0.7;
  const auto displaced = Sensors(settings, 0).believed({car}, 2, t0).value()[0];
  const double dx = displaced.x_at(0) - table->at(0).x, dy = displaced.y_at(0) - table->at(0).y;
  EXPECT_NE(dx, 0);
  EXPECT_NE(dy, dx);
  EXPECT_NEAR(displaced.x_at(3) - table->at(3).x, dx, 1e-12);
  EXPECT_EQ(displaced.pose_at(3).vx, table->at(3).vx);
  // As an obstacle at constant velocity would be.
  const auto plain =
      Sensors(settings, 0).believed({testing::circle("car", 5, 6, 1, 2, 3)}, 2, t0).value()[0];
  EXPECT_NEAR(plain.x - 5, dx, 1e-12);
  EXPECT_NEAR(plain.y - 6, dy, 1e-12);
}

TEST(Sensors, EveryOptionHasADocAndADefaultWithinItsRange) {
  for (const auto& entry : sensing_options().entries()) {
    EXPECT_FALSE(entry.info.doc.empty());
    EXPECT_NO_THROW((void)entry.info.checked(entry.get(SensingSettings{}), "defaults"));
    if (entry.info.name != "obstacle_velocity_factor")
      EXPECT_FALSE(entry.info.range.contains(-0.1)) << entry.info.name;
  }
}

}  // namespace
}  // namespace slalom::sim
