#include "slalom/vehicle/parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "slalom/base/error.hpp"

namespace slalom::vehicle {
namespace {

TEST(Parameters, EveryOptionHasUnitDocAndAcceptsItsDefault) {
  std::set<std::string> names;
  const Parameters defaults;
  for (const auto& entry : parameter_options().entries()) {
    EXPECT_TRUE(names.insert(entry.info.name).second) << entry.info.name << " registered twice";
    EXPECT_FALSE(entry.info.doc.empty()) << entry.info.name;
    const bool number =
        entry.info.kind == OptionKind::real || entry.info.kind == OptionKind::vector;
    EXPECT_TRUE(!number || !entry.info.unit.empty()) << entry.info.name;
    EXPECT_NO_THROW((void)entry.info.checked(entry.get(defaults), "defaults")) << entry.info.name;
  }
  // One option for each member: a member that was forgotten would leave bytes over.
  std::size_t bytes = 0;
  for (const auto& entry : parameter_options().entries()) {
    if (entry.info.kind == OptionKind::text) bytes += sizeof(std::string);
    if (entry.info.kind == OptionKind::real) bytes += sizeof(double);
    if (entry.info.kind == OptionKind::vector) bytes += entry.info.length * sizeof(double);
    const bool padded =
        entry.info.kind == OptionKind::boolean || entry.info.kind == OptionKind::choice;
    if (padded) bytes += sizeof(double);
  }
  EXPECT_EQ(bytes, sizeof(Parameters));
}

TEST(Parameters, OptionsReachTheMemberOfTheirName) {
  Parameters p;
  const auto& table = parameter_options();
  table.set(p, *table.find("la"), 1.25, "test");
  table.set(p, *table.find("PVY2"), -3.0, "test");
  table.set(p, *table.find("tyre_asymmetry"), false, "test");
  table.set(p, *table.find("ax_min"), std::vector<double>{1, 2, 3, 4}, "test");
  EXPECT_EQ(p.la, 1.25);
  EXPECT_EQ(p.PVY2, -3.0);
  EXPECT_FALSE(p.tyre_asymmetry);
  EXPECT_EQ(p.ax_min, (std::array<double, 4>{1, 2, 3, 4}));
}

// Each registered number, changed through its option, must change exactly its own value.
TEST(Parameters, NoTwoOptionsShareAMember) {
  const auto& entries = parameter_options().entries();
  for (const auto& entry : entries) {
    if (entry.info.kind != OptionKind::real) continue;
    Parameters p;
    entry.set(p, OptionValue{0.123456});
    for (const auto& other : entries) {
      const bool changed = other.info.name == entry.info.name;
      EXPECT_EQ(other.get(p), changed ? OptionValue{0.123456} : other.get(Parameters{}))
          << other.info.name;
    }
  }
}

TEST(Parameters, DegreesBecomeRadians) {
  const Parameters p;
  EXPECT_NEAR(p.sa_max(), std::numbers::pi / 6, 1e-16);
  EXPECT_NEAR(p.sr_max(), std::numbers::pi / 36, 1e-16);
}

TEST(Parameters, ContradictionsAreRefusedWithPlaceAndRule) {
  EXPECT_NO_THROW(check(Parameters{}, "file"));
  const auto message = [](auto change) -> std::string {
    Parameters p;
    change(p);
    try {
      check(p, "car.yaml");
    } catch (const InvalidValue& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message([](auto& p) { p.m = -1; }), "car.yaml: found m = -1, expected a number > 0");
  EXPECT_NE(
      message([](auto& p) { p.KZX = std::numeric_limits<double>::quiet_NaN(); }).find("KZX = nan"),
      std::string::npos);
  EXPECT_NE(message([](auto& p) { p.ux_min = 30; }).find("ux_max = 29"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.ax_max[3] = -10; }).find("less than ax_max"),
            std::string::npos);
  EXPECT_NE(message([](auto& p) { p.sa_max_deg = 90; }).find("sa_max_deg"), std::string::npos);
}

}  // namespace
}  // namespace slalom::vehicle
