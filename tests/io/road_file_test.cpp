// Roads and goals of the road in scenario files.

#include <gtest/gtest.h>

#include "io/files.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sim/closed_loop.hpp"

namespace slalom::io {
namespace {

const std::string kRoad =
    "road: {points: [[-20, 0, 4, 4], [20, 0, 4, 4], [60, 5, 4, 4], [95, 22, 3.5, 4]], closed: "
    "false, "
    "lanes: [[[-20, 0], [20, 0.5]]]}\n";

sim::Scenario parsed(const std::string& goal, const std::string& road = kRoad) {
  return parse_scenario(
      "planner: P_E\nstart: {x: 0, y: 0, psi: 0, ux: 12}\ngoal: " + goal + "\n" + road, "my.yaml");
}

std::string message(const std::string& goal, const std::string& road = kRoad) {
  try {
    parsed(goal, road);
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "";
}

TEST(RoadFile, IsReadWithItsGoal) {
  const auto scenario = parsed("{s: 90}");
  ASSERT_TRUE(scenario.road);
  EXPECT_EQ(scenario.road->points().size(), 4u);
  EXPECT_EQ(scenario.road->points()[3].right, 3.5);
  EXPECT_EQ(scenario.road->lanes().size(), 1u);
  EXPECT_EQ(scenario.goal.kind(), world::GoalKind::line);
  EXPECT_NEAR(scenario.goal.x, scenario.road->at(90).x, 1e-12);
}

TEST(RoadFile, IsReadFromATableOfARaceTrack) {
  test::TemporaryFolder folder;
  test::write(folder / "track.csv",
              "# x_m,y_m,w_tr_right_m,w_tr_left_m\n-20,0,4,4\n20,0,4,4\n60,5,4,4\n95,22,3.5,4\n");
  test::write(folder / "my.yaml",
              "start: {x: 0, y: 0, psi: 0}\ngoal: {s: 90}\nroad: {file: track.csv}\n");
  const auto scenario = load_scenario({folder / "my.yaml", {}, {}, {}});
  EXPECT_EQ(scenario.road->length(), parsed("{s: 90}").road->length());
  // As spreadsheets write it.
  test::write(
      folder / "track.csv",
      "\xEF\xBB\xBFx_m,y_m,w_tr_right_m,w_tr_left_m\n-20,0,4,4\n20,0,4,4\n60,5,4,4\n95,22,3.5,4\n");
  EXPECT_EQ(load_scenario({folder / "my.yaml", {}, {}, {}}).road->length(),
            scenario.road->length());
}

TEST(RoadFile, RefusesWhatSaysNothingOfAGoalOfTheRoad) {
  for (const char* key : {"psi: 0.1", "psi_deg: 9", "sigma: 3"})
    EXPECT_NE(message("{s: 90, " + std::string(key) + "}").find(" beside s"), std::string::npos);
}

TEST(RoadFile, WhatSaysNothingOfAGoalIsRefusedFromTheCommandLineToo) {
  const std::string text = "start: {x: 0, y: 0, psi: 0, ux: 12}\nplanner: P_E\n" + kRoad + "goal: ";
  const auto with = [&](const std::string& goal, const std::vector<std::string>& set) {
    try {
      (void)parse_scenario(text + goal, ScenarioRequest{"my.yaml", {}, {}, set, {}});
    } catch (const InvalidValue& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  for (const char* key : {"sigma=3", "x=20", "y=0", "psi=0", "psi_deg=3"})
    for (const char* goal : {"{s: 90}", "{time: 8}"}) {
      const auto found = with(goal, {std::string("goal.") + key});
      EXPECT_NE(found.find("--set goal." + std::string(key).substr(0, std::string(key).find('='))),
                std::string::npos)
          << found;
      EXPECT_NE(found.find("of the goal beside "), std::string::npos) << found;
    }
  const std::string box = "{x: 60, y: 5, length: 8, width: 4}";
  EXPECT_NE(with(box, {"goal.sigma=3"}).find("sigma of the goal beside length"), std::string::npos);
  EXPECT_NE(with("{x: 60, y: 5, sigma: 15, length: 8, width: 4}", {}).find("my.yaml:"),
            std::string::npos);
  EXPECT_EQ(with(box, {"goal.x=61", "goal.psi_deg=10"}), "taken");
  EXPECT_EQ(with("{s: 90}", {"goal.s=80", "goal.ux_max=9"}), "taken");
  // Another goal in the place of the file's.
  EXPECT_EQ(with("{x: 60, y: 5, psi: 0, sigma: 3}", {"goal.s=80"}), "taken");
  EXPECT_EQ(with("{x: 60, y: 5, sigma: 3}", {"goal.length=8", "goal.width=4"}), "taken");
}

/// On a straight road to x = `last` [m], with a row of its table each metre.
sim::Scenario on_a_long_road(int last) {
  test::TemporaryFolder folder;
  std::string rows = "# x_m,y_m,w_tr_right_m,w_tr_left_m\n";
  for (int k = -20; k < last; ++k) rows += std::to_string(k) + ",0,4,4\n";
  test::write(folder / "track.csv", rows);
  test::write(folder / "my.yaml",
              "start: {x: 0, y: 0, psi: 0}\ngoal: {s: 90}\nroad: {file: track.csv}\n");
  return load_scenario({folder / "my.yaml", {}, {}, {}});
}

TEST(RoadFile, RefusesMoreThanAResolvedFileCanHold) {
  try {
    on_a_long_road(75000);
    ADD_FAILURE() << "not refused";
  } catch (const InvalidValue& error) {
    EXPECT_NE(std::string(error.what()).find("tables of 375100 numbers"), std::string::npos)
        << error.what();
  }
}

TEST(RoadFile, AResolvedFileOfALongRoadIsReadAgain) {
  const auto scenario = on_a_long_road(30000);
  EXPECT_EQ(parse_scenario(to_yaml(scenario), "resolved.yaml").road->length(),
            scenario.road->length());
}

TEST(RoadFile, AResolvedFileHasItAll) {
  for (const char* goal : {"{s: 90}", "{time: 8}",
                           "{x: 60, y: 5, psi: 0.3, length: 8, width: 4, "
                           "psi_tolerance: 0.2, ux_max: 9, t_max: 20}"}) {
    const auto text = to_yaml(parsed(goal));
    EXPECT_EQ(to_yaml(parse_scenario(text, "resolved.yaml")), text) << text;
  }
}

TEST(RoadFile, AResolvedFileGivesTheSameDrive) {
  auto scenario = parsed("{s: 90}");
  scenario.planner.arrival_N = 15;
  scenario.planner.search_places = 5000;
  const auto again = parse_scenario(to_yaml(scenario), "resolved.yaml");
  const auto one = sim::drive(scenario), other = sim::drive(again);
  EXPECT_EQ(one.outcome, sim::Outcome::goal) << one.message;
  ASSERT_EQ(one.plant.size(), other.plant.size());
  EXPECT_EQ(one.plant.back().state, other.plant.back().state);
}

TEST(RoadFile, SaysWhatIsWrongAndWhere) {
  const auto contains = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("my.yaml:"), std::string::npos) << text;
  };
  contains(message("{s: 900}"), "my.yaml:3");
  contains(message("{s: 90, x: 3, y: 4}"), "s and x and y");
  contains(message("{psi: 0}"), "goal without 'x'");
  contains(message("{x: 4, y: 40}"), "off the road");
  contains(message("{time: 5}", ""), "without a road");
  contains(message("{laps: 2}"), "closed road");
  contains(message("{s: 90}", "road: {closed: true}\n"), "without points");
  for (const char* closed : {"maybe", "2", "0.5", "[1, 2]"})
    contains(message("{s: 90}", std::string("road: {closed: ") + closed +
                                    ", points: [[-20, 0, 4, 4], [20, 0, 4, 4], [99, 0, 4, 4]]}\n"),
             "true or false");
  contains(message("{s: 90}", "road: {points: [[0, 0, 1, 1]]}\n"), "1 points");
  contains(message("{s: 90}", "road: {points: [[0, 0, 1], [9, 0, 1]]}\n"), "3 numbers");
  contains(message("{s: 90}", "road: {points: [[0, 0, 1, 1], [9, 0, 1, 1]], width: 4}\n"),
           "'width'");
  contains(message("{s: 40}", "road: {points: [[0, 9, 4, 4], [60, 9, 4, 4]]}\n"), "start");
}

}  // namespace
}  // namespace slalom::io
