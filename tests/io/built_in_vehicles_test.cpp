#include <gtest/gtest.h>

#include "slalom/io/scenario_file.hpp"
#include "slalom/vehicle/plausible.hpp"

namespace slalom::io {
namespace {

sim::Scenario with_vehicle(const std::string& vehicle, std::vector<std::string> overrides = {}) {
  return load_scenario({"E_A", std::nullopt, std::nullopt, std::move(overrides), vehicle});
}

TEST(BuiltInVehicles, ArePlausible) {
  std::vector<std::string> names;
  for (const auto& file : built_in_vehicles()) {
    names.push_back(file.name);
    const auto vehicle = with_vehicle(file.name).vehicle;
    EXPECT_EQ(vehicle.name, file.name);
    EXPECT_EQ(vehicle::implausible(vehicle), std::vector<std::string>{}) << file.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"bmw_320i", "ford_escort", "hmmwv", "vw_vanagon"}));
}

/// The HMMWV's own defaults are under every file: one that leaves a setting out takes it from
/// there.
TEST(BuiltInVehicles, TakeNothingFromTheHmmwv) {
  const auto car = with_vehicle("vw_vanagon").vehicle;
  for (const auto& entry : vehicle::parameter_options().entries()) {
    if (entry.info.kind != OptionKind::real || entry.get(car) != entry.get({})) continue;
    const auto& name = entry.info.name;
    EXPECT_TRUE(name == "psi_max" || name == "ux_min" || name == "EP") << name;
  }
}

TEST(BuiltInVehicles, AChosenOneComesBeforeWhatIsSet) {
  const auto scenario = with_vehicle("bmw_320i", {"vehicle.ux_max=40"});
  EXPECT_EQ(scenario.vehicle.ux_max, 40);
  EXPECT_NEAR(scenario.vehicle.m, 1093.295, 0.001);
  EXPECT_EQ(scenario.vehicle.tyre, vehicle::TyreKind::combined_slip);
  const auto again = parse_scenario(to_yaml(scenario), "again");
  for (const auto& entry : vehicle::parameter_options().entries())
    EXPECT_EQ(entry.get(again.vehicle), entry.get(scenario.vehicle)) << entry.info.name;
}

}  // namespace
}  // namespace slalom::io
