// What each factor does to the vehicle that is driven.

#include "slalom/sim/plant_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "slalom/base/error.hpp"
#include "slalom/vehicle/model.hpp"

namespace slalom::sim {
namespace {

using vehicle::Dynamics;
using vehicle::Parameters;
using vehicle::State;

Parameters driven(const Parameters& believed, const PlantSettings& settings) {
  return plant_vehicle(believed, settings, "test");
}

Parameters symmetric() {
  Parameters p;
  p.tyre_asymmetry = false;
  return p;
}

State straight_on(double ax = 0) {
  return {0, 0, 0, 0, 0, 0, 20, ax};
}

/// Force [N] of the front axle at a steering angle; its slip angle is the negative.
double front_force(const Parameters& p, double sa) {
  State state = straight_on();
  state[vehicle::SA] = sa;
  return Dynamics(p).tyre_forces(state)[0];
}

double peak(const Parameters& p) {
  double most = 0;
  for (double sa = 0; sa < 0.6; sa += 0.002) most = std::max(most, front_force(p, sa));
  return most;
}

double slope(const Parameters& p) {
  return front_force(p, 1e-4) / 1e-4;
}

TEST(PlantSettings, DefaultsChangeNoBit) {
  const Parameters believed, plant = driven(believed, {});
  for (const auto& entry : vehicle::parameter_options().entries())
    EXPECT_EQ(entry.get(believed), entry.get(plant)) << entry.info.name;
}

TEST(PlantSettings, MassTakesInertiaLoadsAndTransferWithIt) {
  const Parameters believed = symmetric(), heavy = driven(believed, {.mass_factor = 1.5});
  EXPECT_DOUBLE_EQ(heavy.m, 1.5 * believed.m);
  EXPECT_DOUBLE_EQ(heavy.Izz, 1.5 * believed.Izz);
  // Accelerating straight on, every wheel bears half as much again.
  const auto before = Dynamics(believed).wheel_loads(straight_on(1.3));
  const auto after = Dynamics(heavy).wheel_loads(straight_on(1.3));
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], 1.5 * before[i], 1e-6);
  // At the same sideways acceleration too.
  EXPECT_DOUBLE_EQ(heavy.KZYR, 1.5 * believed.KZYR);
  EXPECT_DOUBLE_EQ(heavy.KZYF, 1.5 * believed.KZYF);
  EXPECT_EQ(heavy.la, believed.la);
  EXPECT_EQ(heavy.PKY1, believed.PKY1);
}

TEST(PlantSettings, FrictionScalesThePeakAndNotTheSlope) {
  const Parameters believed = symmetric(), icy = driven(believed, {.friction_factor = 0.6});
  EXPECT_NEAR(peak(icy), 0.6 * peak(believed), 1e-3 * peak(believed));
  EXPECT_NEAR(slope(icy), slope(believed), 1e-4 * slope(believed));
  EXPECT_EQ(icy.PDX1, 0.6 * believed.PDX1);
}

TEST(PlantSettings, CorneringStiffnessScalesTheSlopeAndNotThePeak) {
  const Parameters believed = symmetric();
  const Parameters soft = driven(believed, {.cornering_stiffness_factor = 0.7});
  EXPECT_NEAR(slope(soft), 0.7 * slope(believed), 1e-4 * slope(believed));
  EXPECT_NEAR(peak(soft), peak(believed), 1e-3 * peak(believed));
}

TEST(PlantSettings, TheCentreOfGravityTakesTheStaticLoadsWithIt) {
  const Parameters believed, ahead = driven(believed, {.cg_shift = 0.25});
  const double L = believed.la + believed.lb, W = believed.FzF0 + believed.FzR0;
  EXPECT_DOUBLE_EQ(ahead.la, believed.la - 0.25);
  EXPECT_DOUBLE_EQ(ahead.la + ahead.lb, L);
  EXPECT_NEAR(ahead.FzF0, believed.FzF0 + W * 0.25 / L, 1e-9);
  EXPECT_NEAR(ahead.FzF0 + ahead.FzR0, W, 1e-9);
}

TEST(PlantSettings, StraightOnStaysWhatItWas) {
  const auto believed = Dynamics(Parameters{}).tyre_forces(straight_on());
  for (const PlantSettings& settings :
       {PlantSettings{.mass_factor = 1.3}, PlantSettings{.friction_factor = 0.5},
        PlantSettings{.cornering_stiffness_factor = 0.5}, PlantSettings{.cg_shift = -0.3}}) {
    const auto forces = Dynamics(driven({}, settings)).tyre_forces(straight_on());
    EXPECT_NEAR(forces[0], believed[0], 1e-6);
    EXPECT_NEAR(forces[1], believed[1], 1e-6);
  }
}

TEST(PlantSettings, BadOnesAreRefusedByName) {
  const auto message = [](const PlantSettings& settings) -> std::string {
    try {
      plant_options().check(settings, "E.yaml: plant");
      (void)plant_vehicle({}, settings, "E.yaml");
    } catch (const InvalidValue& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_NE(message({.mass_factor = 0}).find("mass_factor = 0"), std::string::npos);
  EXPECT_NE(message({.friction_factor = -1}).find("friction_factor = -1"), std::string::npos);
  EXPECT_NE(message({.cornering_stiffness_factor = std::nan("")}).find("nan"), std::string::npos);
  EXPECT_NE(message({.actuator_delay = -0.1}).find("actuator_delay = -0.1"), std::string::npos);
  EXPECT_NE(message({.cg_shift = 1.6}).find("plant: found cg_shift = 1.6, expected between"),
            std::string::npos);
  EXPECT_NE(message({.cg_shift = -1.72}).find("FzF0"), std::string::npos);  // no load in front
  EXPECT_EQ(message({.mass_factor = 1.2, .cg_shift = 0.2}), "accepted");
}

TEST(PlantSettings, EveryOptionHasADocAndADefaultWithinItsRange) {
  for (const auto& entry : plant_options().entries()) {
    EXPECT_FALSE(entry.info.doc.empty());
    EXPECT_NO_THROW((void)entry.info.checked(entry.get(PlantSettings{}), "defaults"));
  }
}

}  // namespace
}  // namespace slalom::sim
