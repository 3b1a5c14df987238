#include "slalom/vehicle/derived.hpp"

#include <gtest/gtest.h>

#include "slalom/vehicle/plant.hpp"

namespace slalom::vehicle {
namespace {

using Names = std::vector<std::string>;

TEST(Derived, TheHmmwvsOwnNumbersComeOutOfIts) {
  Parameters p;
  const Parameters hmmwv;
  EXPECT_EQ(derive(p, {"h", "track", "FZ0"}),
            (Names{"KZX", "KZYR", "KZYF", "F_offset_front", "F_offset_rear"}));
  EXPECT_NEAR(p.KZX, hmmwv.KZX, 0.01);
  EXPECT_NEAR(p.KZYR, hmmwv.KZYR, 0.01);
  EXPECT_NEAR(p.KZYF, hmmwv.KZYF, 0.01);
  // The published offsets leave .02 N of some 10^4.
  EXPECT_NEAR(p.F_offset_front, hmmwv.F_offset_front, 0.03);
  EXPECT_NEAR(p.F_offset_rear, hmmwv.F_offset_rear, 0.03);
}

TEST(Derived, WhatIsStatedStays) {
  Parameters p;
  p.m = 1350;
  p.KZX = 500;
  EXPECT_EQ(derive(p, {"m", "KZX", "FzF0", "FzR0", "KZYF", "F_offset_front"}),
            (Names{"KZYR", "F_offset_rear"}));
  EXPECT_EQ(p.KZX, 500);
  EXPECT_EQ(derive(p, {"ux_max", "width"}), Names{});
}

TEST(Derived, WhatWasStatedBeforeStaysAndIsDerivedFrom) {
  Parameters p;
  p.m = 1350;
  p.FzF0 = 6000;
  EXPECT_EQ(derive(p, {"m"}, {"FzF0", "h"}),
            (Names{"FzR0", "KZX", "KZYR", "KZYF", "F_offset_rear"}));
  EXPECT_EQ(p.FzF0, 6000);
}

/// A car by its data sheet drives straight on when no one steers.
TEST(Derived, AVehicleOfOnesOwnDoesNotPull) {
  Parameters car;
  car.m = 1350;
  car.Izz = 2100;
  car.la = 1.1;
  car.lb = 1.5;
  car.h = 0.55;
  derive(car, {"m", "Izz", "la", "lb", "h"});
  EXPECT_NEAR(car.FzF0, 1350 * 9.80665 * 1.5 / 2.6, 1e-9);
  EXPECT_NEAR(car.FzF0 + car.FzR0, 1350 * 9.80665, 1e-9);
  EXPECT_NEAR(car.KZX, 1350 * 0.55 / 2.6, 1e-9);
  const Plant plant(car, 1e-9, 0.02);
  const State end = plant.predict({0, 0, 0, 0, 0, 0, 20, 0}, {}, 0, 5);
  EXPECT_NEAR(end[Y], 0, 1e-6);
  EXPECT_NEAR(end[PSI], 0, 1e-8);
}

}  // namespace
}  // namespace slalom::vehicle
