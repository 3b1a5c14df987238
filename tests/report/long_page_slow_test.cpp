// The page of a drive that is too long for all of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "report/hour_drive.hpp"
#include "report/markup.hpp"
#include "slalom/report/report.hpp"

namespace slalom::report {
namespace {

using namespace testing;

/// One drive and its page, for all tests.
struct Made {
  HourDrive hour = hour_drive();
  std::string page = drive_page(hour.scenario, hour.drive);
  nlohmann::json data = page_data(page);
};

const Made& made() {
  static const Made all;
  return all;
}

TEST(LongPage, IsSmall) {
  EXPECT_LT(made().page.size(), 5'000'000U);
  EXPECT_GT(made().page.size(), 3'500'000U) << "what there is room for is there";
}

TEST(LongPage, HasEveryDipOfWheelLoadAndClearance) {
  const auto& [hour, page, data] = made();
  const auto& plant = data["plant"];
  EXPECT_EQ(plant["t"].front(), 0);
  EXPECT_EQ(plant["t"].back(), 3600);
  EXPECT_LE(plant["t"].size(), 11'000U);
  std::map<double, std::size_t> at;
  for (std::size_t i = 0; i < plant["t"].size(); ++i) at[plant["t"][i]] = i;
  ASSERT_GT(hour.dips.size(), 150U);
  for (const std::size_t k : hour.dips) {
    const auto& sample = hour.drive.plant[k];
    const auto found = at.lower_bound(sample.t - 1e-6);
    ASSERT_TRUE(found != at.end());
    ASSERT_NEAR(found->first, sample.t, 1e-6);
    EXPECT_NEAR(plant["clearance"][found->second], sample.clearance, 1e-4);
    const auto wheel = std::string(vehicle::kWheelNames[k % 4]);
    EXPECT_NEAR(plant[wheel][found->second], sample.wheel_loads[k % 4], 0.06);
  }
}

TEST(LongPage, DrawsSignalsAsTheyWere) {
  const auto& [hour, page, data] = made();
  const auto& plant = data["plant"];
  std::size_t i = 0;
  double most = 0;
  for (const auto& sample : hour.drive.plant) {
    while (i + 2 < plant["t"].size() && plant["t"][i + 1] < sample.t) ++i;
    const double t0 = plant["t"][i], t1 = plant["t"][i + 1];
    const double share = (sample.t - t0) / (t1 - t0);
    const double ux = (1 - share) * double(plant["ux"][i]) + share * double(plant["ux"][i + 1]);
    most = std::max(most, std::fabs(ux - sample.state[vehicle::UX]));
  }
  EXPECT_LT(most, 0.2) << "of 6.6 m/s";
}

TEST(LongPage, HasTheCyclesThatTellSomething) {
  const auto& [hour, page, data] = made();
  std::map<std::size_t, const nlohmann::json*> cycles;
  for (const auto& cycle : data["cycles"]) cycles[cycle["index"]] = &cycle;
  EXPECT_LT(cycles.size(), hour.drive.cycles.size());
  for (const std::size_t k : {std::size_t{0}, hour.drive.cycles.size() - 1, hour.slowest})
    EXPECT_EQ(cycles.count(k), 1U) << k;
  ASSERT_GT(hour.unsolved.size(), 50U);
  for (const std::size_t k : hour.unsolved) EXPECT_EQ(cycles.count(k), 1U) << k;
  for (const auto& [k, cycle] : cycles) {
    EXPECT_GE((*cycle)["plan"]["t"].size(), 5U);
    EXPECT_EQ((*cycle)["plan"]["t"].back(), std::round(hour.drive.cycles[k].plan.tf * 1e6) / 1e6);
  }
  EXPECT_EQ(cycles.at(hour.slowest)->at("candidates").size(), 4U);
  std::size_t gap = 0, last = 0;
  for (const auto& [k, cycle] : cycles) {
    gap = std::max(gap, k - last);
    if (k > last + 1) {
      const auto& before = *cycles.at(last);
      EXPECT_EQ(before["left_out"], k - last - 1);
      EXPECT_NEAR(before["until"], hour.drive.cycles[last + 1].t_swap, 1e-6);
    }
    last = k;
  }
  EXPECT_LT(gap, 150U) << "of .1 s";
}

TEST(LongPage, SaysWhatIsLeftOut) {
  const auto& [hour, page, data] = made();
  const auto& left = data["left_out"];
  EXPECT_EQ(left["samples"], nlohmann::json::array({data["plant"]["t"].size(), 180'001}));
  EXPECT_EQ(left["cycles"], nlohmann::json::array({data["cycles"].size(), 36'001}));
  std::size_t detailed = 0, nodes = 0;
  for (const auto& cycle : data["cycles"]) {
    detailed += cycle.contains("candidates") ? 1 : 0;
    nodes = std::max(nodes, cycle["plan"]["t"].size());
  }
  EXPECT_EQ(left["detailed"], detailed);
  EXPECT_GT(detailed, 100U);
  EXPECT_EQ(left["nodes"], nodes);
  // Counted of all cycles.
  EXPECT_EQ(data["rungs"]["least_bad"], hour.unsolved.size());
  EXPECT_EQ(data["rungs"]["new"].get<std::size_t>() + data["rungs"]["rest"].get<std::size_t>(),
            36'000 - hour.unsolved.size());
  EXPECT_TRUE(page_data(drive_page(synthetic_scenario(), synthetic_drive()))["left_out"].is_null());
}

TEST(LongPage, OfLongNamesAndPlacesFarAwayIsSmall) {
  auto hour = hour_drive();
  for (auto& cycle : hour.drive.cycles) {
    cycle.plan.report.worst_constraint = std::string(300, 'x');
    for (auto& state : cycle.plan.states) state[vehicle::Y] += 5.4e6;
  }
  for (auto& sample : hour.drive.plant) sample.state[vehicle::Y] += 5.4e6;
  EXPECT_LT(drive_page(hour.scenario, hour.drive).size(), 5'000'000U);
}

}  // namespace
}  // namespace slalom::report
