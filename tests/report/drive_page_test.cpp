#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "report/markup.hpp"
#include "report/synthetic_drive.hpp"
#include "slalom/report/report.hpp"

namespace slalom::report {
namespace {

using namespace testing;

TEST(DrivePage, CarriesTheDrive) {
  const auto drive = synthetic_drive();
  const auto data = page_data(drive_page(synthetic_scenario(), drive));
  ASSERT_EQ(data["plant"]["t"].size(), drive.plant.size());
  EXPECT_NEAR(data["plant"]["y"].back(), 68, 1e-3);
  EXPECT_EQ(data["outcome"], "goal");
  EXPECT_EQ(data["obstacles"][1]["vy"], -2);
  EXPECT_EQ(data["region"]["x_min"], -12);
  EXPECT_TRUE(data["region"]["x_max"].is_null());
  ASSERT_EQ(data["cycles"].size(), drive.cycles.size());
  EXPECT_TRUE(data["cycles"][2]["plan"]["held"].is_null());
  EXPECT_DOUBLE_EQ(data["cycles"][3]["plan"]["held"], drive.cycles[3].plan.obstacle_time_held);
}

TEST(DrivePage, CarriesWhatWasVerified) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  auto drive = synthetic_drive();
  auto& plan = drive.cycles[2].plan;
  plan.rung = planner::Rung::rest;
  plan.certificate = {true, inf, "", 2100, 7.5, "", 0};
  plan.candidates = {{"rest", 12, plan.certificate},
                     {"way <1>", 0, {false, -1, "O1", 900, 5, "clearance to O1", 3}}};
  const auto data = page_data(drive_page(synthetic_scenario(), drive));
  const auto& cycle = data["cycles"][2];
  EXPECT_EQ(cycle["rung"], "rest");
  EXPECT_TRUE(cycle["certificate"]["clearance"].is_null()) << "no obstacle";
  ASSERT_EQ(cycle["candidates"].size(), 2U);
  EXPECT_EQ(cycle["candidates"][0]["cost"], 12);
  EXPECT_TRUE(cycle["candidates"][1]["cost"].is_null()) << "only verified ones are compared";
  EXPECT_EQ(cycle["candidates"][1]["certificate"]["refused"], "clearance to O1");
  EXPECT_FALSE(data["cycles"][1].contains("rung"));
}

TEST(DrivePage, CarriesTheLimitsOfAcceleration) {
  auto scenario = synthetic_scenario();
  scenario.vehicle.power = 40e3;
  const auto limits = page_data(drive_page(scenario, synthetic_drive()))["vehicle"]["ax_limits"];
  const double step = limits["ux_step"];
  ASSERT_EQ(limits["most"].size(), 61U);
  EXPECT_NEAR(60 * step, scenario.vehicle.ux_max, 1e-12);
  EXPECT_NEAR(limits["most"][40], scenario.vehicle.ax_max_at(40 * step), 1e-4);
  EXPECT_NEAR(limits["least"][40], scenario.vehicle.ax_min_at(40 * step), 1e-4);
}

TEST(DrivePage, SaysHowTheDriveEnded) {
  auto drive = synthetic_drive();
  EXPECT_EQ(count(drive_page(synthetic_scenario(), drive), "Reached the goal</p>"), 1);
  drive.outcome = sim::Outcome::crash;
  drive.hit = "O2";
  EXPECT_EQ(count(drive_page(synthetic_scenario(), drive), "Crashed into O2</p>"), 1);
}

TEST(DrivePage, IsSelfContained) {
  const auto page = drive_page(synthetic_scenario(), synthetic_drive());
  EXPECT_EQ(count(page, "{{"), 0);
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!data:)")));
  EXPECT_FALSE(
      std::regex_search(page, std::regex("url\\((?!#)|@import|https?://(?!www\\.w3\\.org)")));
}

TEST(DrivePage, OfAnHoursDriveIsSmall) {
  auto drive = synthetic_drive();
  const auto sample = drive.plant.back();
  const auto cycle = drive.cycles.back();
  const double first = drive.plant.front().t;
  drive.plant.clear();
  drive.cycles.resize(1);
  for (int k = 0; k < 180'000; ++k) {
    drive.plant.push_back(sample);
    drive.plant.back().t = first + 0.02 * k;
  }
  for (int k = 1; k <= 7'200; ++k) {
    drive.cycles.push_back(cycle);
    drive.cycles.back().index = k;
  }
  const auto page = drive_page(synthetic_scenario(), drive);
  EXPECT_LT(page.size(), 5'000'000u);
  const auto data = page_data(page);
  EXPECT_EQ(data["plant"]["t"].front(), first);
  EXPECT_NEAR(data["plant"]["t"].back(), drive.plant.back().t, 1e-6);
  const auto& plan = data["cycles"].back()["plan"];
  EXPECT_EQ(plan["x"].size(), plan["t"].size());
  EXPECT_DOUBLE_EQ(plan["t"].back(), cycle.plan.t.back());
}

TEST(DrivePage, SaysWhatTheOutcomeDoesNot) {
  auto drive = synthetic_drive();
  auto& plan = drive.cycles[2].plan;
  plan.report.status = planner::PlanStatus::passes_through;
  plan.report.passage = {1.25, "O<2>", 3};
  drive.cycles[1].plan.report.blocks = "O1 in the way";
  const auto page = drive_page(synthetic_scenario(), drive);
  EXPECT_EQ(count(page, "data-kind=\"passes_through\">1 plan goes through an obstacle"), 1);
  EXPECT_EQ(count(page, "1.25 m into the margin of O&lt;2&gt; at 3.00 s"), 1);
  const auto data = page_data(page);
  EXPECT_EQ(data["marks"][0]["times"][0], drive.cycles[2].t_swap);
  EXPECT_EQ(data["cycles"][2]["passage"][1], "O<2>");
  EXPECT_EQ(data["cycles"][1]["blocks"], "O1 in the way");
}

TEST(DrivePage, WithstandsOddDrives) {
  for (const auto& odd : odd_drives()) {
    SCOPED_TRACE(odd.name);
    const auto page = drive_page(odd.scenario, odd.drive);
    const auto data = page_data(page);
    EXPECT_EQ(data["plant"]["t"].size(), odd.drive.plant.size());
    EXPECT_EQ(count(page, "<script"), 2);
    EXPECT_EQ(count(page, "</script"), 2);
    EXPECT_EQ(count(page, "alert(1)</script>"), 0);
  }
}

TEST(DrivePage, ShowsInfiniteClearanceAsNone) {
  const auto odd = odd_drives()[2];
  const auto data = page_data(drive_page(odd.scenario, odd.drive));
  EXPECT_TRUE(data["plant"]["clearance"][0].is_null());
  EXPECT_TRUE(data["least_clearance_t"].is_null());
}

TEST(DriveFigures, AreWellFormed) {
  auto list = odd_drives();
  list.push_back({"a whole drive", synthetic_scenario(), synthetic_drive()});
  for (const auto& odd : list) {
    const auto figures = drive_figures(odd.scenario, odd.drive);
    ASSERT_EQ(figures.size(), 7u);
    for (const auto& figure : figures) {
      SCOPED_TRACE(odd.name + ": " + figure.file);
      EXPECT_NO_THROW(parse_xml(figure.svg));
      EXPECT_FALSE(std::regex_search(figure.svg, std::regex("=\"[^\"]*\\b(nan|inf)\\b")));
      EXPECT_FALSE(figure.caption.empty());
    }
  }
}

TEST(DriveFigures, SayOnceHowFarFromZeroPlacesAre) {
  auto scenario = synthetic_scenario();
  auto drive = synthetic_drive();
  const double x = 500'000, y = 5.4e6;
  scenario.start[vehicle::X] += x;
  scenario.start[vehicle::Y] += y;
  scenario.goal.x += x;
  scenario.goal.y += y;
  scenario.region = {};
  for (auto& o : scenario.obstacles) {
    o.x += x;
    o.y += y;
  }
  for (auto& sample : drive.plant) {
    sample.state[vehicle::X] += x;
    sample.state[vehicle::Y] += y;
  }
  const auto path = drive_figures(scenario, drive).front().svg;
  EXPECT_EQ(count(path, "x [m] +5e5</text>"), 1);
  EXPECT_EQ(count(path, "y [m] +5.4e6</text>"), 1);
  EXPECT_GT(count(path, ">40</text>"), 0);
  EXPECT_FALSE(std::regex_search(path, std::regex(">[0-9]{5,}</text>")));
}

TEST(DriveFigures, HaveTheNamesThatAreDocumented) {
  std::vector<std::string> names;
  for (const auto& figure : drive_figures(synthetic_scenario(), synthetic_drive()))
    names.push_back(figure.file);
  EXPECT_EQ(names,
            (std::vector<std::string>{"path.svg", "speed.svg", "acceleration.svg", "steering.svg",
                                      "lateral.svg", "wheel_loads.svg", "solve_time.svg"}));
}

}  // namespace
}  // namespace slalom::report
