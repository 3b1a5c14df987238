#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <numbers>
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
  EXPECT_DOUBLE_EQ(data["cycles"][3]["plan"]["held"],
                   drive.cycles[3].plan.obstacle_time_held.value());
}

TEST(DrivePage, CarriesShapesAndMotions) {
  auto scenario = synthetic_scenario();
  auto& box = scenario.obstacles[0];
  box.outline = std::make_shared<world::Polygon>(world::Polygon::rectangle(4, 2));
  box.psi = 0.5;
  auto& car = scenario.obstacles[1];
  const auto table = std::make_shared<world::TableTrajectory>(
      std::vector<world::TrajectoryRow>{
          {1, 0, 0, 0}, {2, 9, 1, 0.3}, {3, 14, 6, 1}, {30, 99, 9, 0}},
      world::BeyondEnd::absent, world::BeyondEnd::stands, "O2");
  car.trajectory = table;
  car.margin_rate = 0.1;
  scenario.vehicle.footprint = vehicle::FootprintKind::rectangle;
  const auto data = page_data(drive_page(scenario, synthetic_drive()));
  EXPECT_EQ(data["vehicle"]["footprint"], "rectangle");
  EXPECT_EQ(data["obstacles"][0]["polygon"].size(), 4U);
  EXPECT_EQ(data["obstacles"][0]["psi"], 0.5);
  EXPECT_FALSE(data["obstacles"][0].contains("track"));
  const auto& track = data["obstacles"][1]["track"];
  EXPECT_EQ(data["obstacles"][1]["margin"][1], 0.1);
  EXPECT_NEAR(data["obstacles"][1]["there"][0], 1, 2e-3);
  EXPECT_TRUE(data["obstacles"][1]["there"][1].is_null());
  const auto rows = track["t"].size();
  ASSERT_GT(rows, 5U);
  EXPECT_LT(rows, 40U);
  EXPECT_NEAR(track["t"].back(), 5.5, 1e-9) << "when the last plan ends";
  // Between the rows, a straight line is within 2 cm of the motion.
  for (std::size_t k = 0; k + 1 < rows; ++k)
    for (const double share : {0., 0.3, 0.5, 1.}) {
      const auto at = [&](const char* column) {
        return (1 - share) * double(track[column][k]) + share * double(track[column][k + 1]);
      };
      const auto pose = table->at(at("t"));
      EXPECT_NEAR(at("x"), pose.x, 0.02);
      EXPECT_NEAR(at("y"), pose.y, 0.02);
      EXPECT_NEAR(at("psi"), pose.psi, 0.02);
    }
}

TEST(DrivePage, CarriesTheRoadAndAGoalAcrossIt) {
  auto scenario = synthetic_scenario();
  const auto plain = page_data(drive_page(scenario, synthetic_drive()));
  EXPECT_FALSE(plain.contains("road"));
  EXPECT_EQ(plain["goal"]["x"].size(), 4U);
  scenario.road = std::make_shared<world::Road>(
      std::vector<world::RoadPoint>{{0, -20, 2, 3}, {0, 40, 2, 3}, {0, 100, 2, 3}}, false,
      std::vector<std::vector<world::Point>>{{{0.5, -20}, {0.5, 100}}}, "road");
  scenario.goal = {};
  scenario.goal.s = 70;
  const auto page = drive_page(scenario, synthetic_drive());
  const auto data = page_data(page);
  for (const auto& p : data["road"]["left"]) EXPECT_NEAR(p[0], -3, 1e-6);
  for (const auto& p : data["road"]["right"]) EXPECT_NEAR(p[0], 2, 1e-6);
  EXPECT_NEAR(data["road"]["middle"].back()[1], 100, 1e-6);
  EXPECT_EQ(data["road"]["lanes"][0].size(), 2U);
  ASSERT_EQ(data["goal"]["y"].size(), 2U);
  EXPECT_NEAR(data["goal"]["y"][0], 50, 1e-6);
  EXPECT_EQ(count(page, ">70 m</td>"), 1);
  const auto path = drive_figures(scenario, synthetic_drive()).front().svg;
  EXPECT_NE(path.find("stroke-dasharray=\"3 3\""), std::string::npos) << "the lane";
}

TEST(DrivePage, AClosedRoadEndsWhereItBegins) {
  auto scenario = synthetic_scenario();
  std::vector<world::RoadPoint> ring;
  for (int k = 0; k < 24; ++k) {
    const double angle = 2 * std::numbers::pi * k / 24;
    ring.push_back({60 * std::cos(angle), 60 * std::sin(angle), 4, 4});
  }
  scenario.road =
      std::make_shared<world::Road>(ring, true, std::vector<std::vector<world::Point>>{}, "ring");
  scenario.goal.laps = 1;
  const auto data = page_data(drive_page(scenario, synthetic_drive()));
  for (const char* line : {"left", "right", "middle"}) {
    const auto& points = data["road"][line];
    EXPECT_NEAR(double(points.front()[0]), double(points.back()[0]), 0.02) << line;
    EXPECT_NEAR(double(points.front()[1]), double(points.back()[1]), 0.02) << line;
  }
  EXPECT_EQ(data["goal"]["x"].size(), 2U) << "laps begin and end at a line";
}

TEST(DrivePage, CarriesWhatWasVerified) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  auto drive = synthetic_drive();
  auto& plan = drive.cycles[2].plan;
  plan.rung = planner::Rung::rest;
  plan.certificate = {true, inf, inf, "", 2100, 7.5, "", 0};
  plan.candidates = {{"rest", 12, plan.certificate},
                     {"way <1>", 0, {false, -1, 0.15, "O1", 900, 5, "clearance to O1", 3}}};
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

TEST(DrivePage, SaysWhichObstacleIsInTheWay) {
  auto scenario = synthetic_scenario();
  scenario.obstacles.push_back({"O1 b", 30, 20, 3, 3, 0, 0});
  auto drive = synthetic_drive();
  const auto blocked = [&](std::size_t k, const char* blocks, const char* row) {
    auto& report = drive.cycles[k].plan.report;
    report.solved = false;
    report.blocks = blocks;
    report.worst_constraint = row;
  };
  blocked(2, "O1 in the way: node 3 of the plan comes 1 m inside its edge",
          "obstacle[O1] at node 3");
  blocked(3, "O1 b in the way: node 1 of", "shaped obstacle[O1 b] at node 1");
  blocked(4, "wheel load falls short by 3", "wheel load at node 1");
  auto& refused = drive.cycles[5].plan;
  refused.rung = planner::Rung::least_bad;
  refused.certificate = {false, 0.1, 0.15, "O2", 2000, 5, "clearance to O2 at 3.25 s", 3.25};
  const auto cycles = page_data(drive_page(scenario, drive))["cycles"];
  EXPECT_EQ(cycles[2]["blocker"]["name"], "O1");
  EXPECT_NEAR(cycles[2]["blocker"]["t"], drive.cycles[2].plan.t_start + drive.cycles[2].plan.t[3],
              1e-3);
  EXPECT_EQ(cycles[3]["blocker"]["name"], "O1 b") << "not O1";
  EXPECT_NEAR(cycles[3]["blocker"]["t"], drive.cycles[3].plan.obstacle_time_held.value(), 1e-3);
  EXPECT_FALSE(cycles[4].contains("blocker"));
  EXPECT_EQ(cycles[5]["blocker"], nlohmann::json({{"name", "O2"}, {"t", 3.25}}));
  EXPECT_FALSE(cycles[1].contains("blocker"));
}

TEST(DrivePage, SaysWhatTheOutcomeDoesNot) {
  auto drive = synthetic_drive();
  auto& plan = drive.cycles[2].plan;
  plan.report.status = planner::PlanStatus::passes_through;
  plan.report.passage = {1.25, "O<2>", 3};
  plan.report.road_exit = {0.25, true, 4};
  drive.cycles[1].plan.report.blocks = "O1 in the way";
  const auto page = drive_page(synthetic_scenario(), drive);
  EXPECT_EQ(count(page, "data-kind=\"passes_through\">1 plan goes through an obstacle"), 1);
  EXPECT_EQ(count(page, "1.25 m into the margin of O&lt;2&gt; at 3.00 s"), 1);
  const auto data = page_data(page);
  EXPECT_EQ(data["marks"][0]["times"][0], drive.cycles[2].t_swap);
  EXPECT_EQ(data["cycles"][2]["passage"][1], "O<2>");
  EXPECT_EQ(data["cycles"][2]["t_swap"], drive.cycles[2].t_swap);
  EXPECT_EQ(data["cycles"][2]["road_exit"], nlohmann::json::array({0.25, "left"}));
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
