// Obstacles of every shape and motion as files state them, and what of such is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/files.hpp"
#include "sim/fakes.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/scenario_file.hpp"

namespace slalom::io {
namespace {

using test::TemporaryFolder;
using world::Obstacle;

const std::string kHead =
    "start: {x: 0, y: 0, psi_deg: 90, ux: 10}\n"
    "goal: {x: 0, y: 100}\n"
    "loop: {timeout: 4}\n"
    "obstacles:\n";

sim::Scenario scenario_of(const std::string& obstacles) {
  return parse_scenario(kHead + obstacles, "my.yaml");
}

Obstacle obstacle_of(const std::string& obstacle) {
  return scenario_of("  - " + obstacle + "\n").obstacles.at(0);
}

TEST(ObstacleReader, Boxes) {
  const auto o =
      obstacle_of("{name: car, x: 5, y: 20, length: 4.5, width: 1.8, psi_deg: 90, vx: 3, vy: 1}");
  ASSERT_TRUE(o.outline);
  EXPECT_DOUBLE_EQ(o.outline->area(), 8.1);
  EXPECT_DOUBLE_EQ(o.psi, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(world::distance(o, 5 + 3, 20 + 1 + 2.25 + 0.5, 1), 0.5);
  EXPECT_NEAR(world::distance(o, 5 + 3 - 0.9 - 0.25, 21, 1), 0.25, 1e-12);
}

TEST(ObstacleReader, PolygonsAndTurnedEllipses) {
  const auto rock = obstacle_of("{x: 5, y: 20, polygon: [[-1, -1], [2, 0], [0, 1]], psi: 0.5}");
  const auto corner = rock.corners_at(0).at(1);
  EXPECT_DOUBLE_EQ(corner.x, 5 + 2 * std::cos(0.5));
  EXPECT_DOUBLE_EQ(corner.y, 20 + 2 * std::sin(0.5));
  const auto egg = obstacle_of("{x: 5, y: 20, a: 3, b: 1, psi_deg: 90}");
  EXPECT_FALSE(egg.is_plain());
  EXPECT_NEAR(world::distance(egg, 5, 24, 0), 1, 1e-12);
}

TEST(ObstacleReader, Paths) {
  const auto o = obstacle_of(
      "{name: walker, r: 0.4, path: [[5, 20], [10, 20], [10, 29]], speed: 1.4, acceleration: 0}");
  EXPECT_NEAR(o.x_at(2), 7.8, 1e-12);
  EXPECT_NEAR(o.y_at(5), 22, 1e-12);
  EXPECT_EQ(o.a, 0.4);
  EXPECT_TRUE(o.moves());
}

TEST(ObstacleReader, TablesInlineAndBesideTheFile) {
  const std::string rows = "[[0, 5, 20, 0.1], [1, 6, 20, 0.2], [3, 9, 22, 0.4]]";
  const auto o =
      obstacle_of("{length: 4, width: 2, table: " + rows + ", before: absent, after: goes_on}");
  EXPECT_DOUBLE_EQ(o.pose_at(1).psi, 0.2);
  EXPECT_FALSE(o.present(-2, -1));
  EXPECT_GT(o.x_at(4), 9);
  TemporaryFolder folder;
  // Columns by their names, in any order, with others beside them.
  test::write(folder / "traffic.csv",
              "# t_s, v_mps, y_m, x_m, psi_rad\n0,1,20,5,0.1\n1, 1, 20, 6, 0.2\n3,1,22,9,0.4\n");
  test::write(folder / "my.yaml", kHead + "  - {r: 1, table: traffic.csv}\n");
  const auto from_file = load_scenario({folder / "my.yaml", {}, {}, {}}).obstacles.at(0);
  for (const double t : {0., 0.4, 1.7, 3.}) EXPECT_EQ(from_file.pose_at(t).x, o.pose_at(t).x) << t;
  // It stands before, and goes on after.
  EXPECT_EQ(from_file.x_at(-9), 5);
  EXPECT_GT(from_file.x_at(9), 15);
}

TEST(ObstacleReader, ATableWithoutHeadingsIsHeadedAlongItsWay) {
  const auto o =
      obstacle_of("{r: 1, table: [[0, 5, 20], [1, 5, 20], [2, 5, 22], [3, 5, 24], [4, 5, 24]]}");
  for (const double t : {0., 1., 2.5, 4.})
    EXPECT_NEAR(o.pose_at(t).psi, std::numbers::pi / 2, 1e-12) << t;
}

TEST(ObstacleReader, MarginsThatGrow) {
  const auto o = obstacle_of("{x: 5, y: 20, r: 1, margin_start: 0.2, margin_rate: 0.1}");
  EXPECT_EQ(o.margin_start, 0.2);
  EXPECT_EQ(o.margin_rate, 0.1);
  EXPECT_TRUE(o.is_plain());
}

const std::string kAll =
    "  - {name: car, x: 5, y: 18.3, length: 4.5, width: 1.8, psi_deg: 31, vx: 0.7, vy: 0.1}\n"
    "  - {name: rock, x: -6.1, y: 21, polygon: [[-1, -1], [2, 0.3], [0, 1]], psi: 0.7}\n"
    "  - {name: egg, x: -4, y: 33, a: 2, b: 0.7, psi: -0.4, margin_start: 0.2, margin_rate: 0.1}\n"
    "  - {name: walker, r: 0.4, path: [[3.5, 30], [5, 31], [9, 29]], speed: 0.3, acceleration: "
    "0.1}\n"
    "  - {name: traffic, length: 4.5, width: 1.8, before: absent, after: goes_on,\n"
    "     table: [[0.3, 12, 1, 1.5], [1.1, 9, 9.7, 1.7], [2, 7, 20, 1.8], [3.3, 4.6, 34, 1.7]]}\n"
    "  - {name: cone, x: 2.9, y: 38, r: 0.2}\n";

TEST(ObstacleReader, AResolvedFileAloneGivesTheSameDriveToTheBit) {
  for (const char* footprint : {"point", "rectangle"}) {
    const auto text = kHead + kAll + "vehicle: {base: hmmwv, footprint: " + footprint + "}\n";
    auto scenario = parse_scenario(text, "my.yaml");
    if (std::string(footprint) == "point") scenario.loop.sm_crash = 0.2;
    const auto again = parse_scenario(to_yaml(scenario), "again.yaml");
    EXPECT_EQ(to_yaml(again), to_yaml(scenario));
    EXPECT_EQ(again.loop.sm_crash, scenario.loop.sm_crash);
    const auto first = sim::drive(scenario, sim::testing::wavy);
    const auto second = sim::drive(again, sim::testing::wavy);
    EXPECT_EQ(first.least_clearance, second.least_clearance);
    EXPECT_EQ(first.least_clearance_obstacle, second.least_clearance_obstacle);
    EXPECT_EQ(first.outcome, second.outcome);
    EXPECT_EQ(first.time, second.time);
    ASSERT_EQ(first.plant.size(), second.plant.size());
    EXPECT_GT(first.plant.size(), 50U);
    for (std::size_t k = 0; k < first.plant.size(); ++k) {
      EXPECT_EQ(first.plant[k].clearance, second.plant[k].clearance);
      EXPECT_EQ(first.plant[k].state, second.plant[k].state);
    }
  }
}

TEST(ObstacleReader, ContactOfABodyIsACrashWhereNoMarginIsStated) {
  const std::string body = "vehicle: {base: hmmwv, footprint: rectangle}\n";
  const auto with = [&](const std::string& loop) {
    return parse_scenario("start: {x: 0, y: 0}\ngoal: {x: 0, y: 100}\n" + body + loop, "my.yaml")
        .loop.sm_crash;
  };
  EXPECT_EQ(with(""), 0);
  EXPECT_EQ(with("loop: {sm_crash: 0.5}\n"), 0.5);
  EXPECT_EQ(parse_scenario(kHead, "my.yaml").loop.sm_crash, 2);
}

TEST(ObstacleReader, AMarginThatIsNotStatedFollowsTheFootprintThroughTheText) {
  const std::string head = "start: {x: 0, y: 0}\ngoal: {x: 0, y: 100}\n";
  const auto changed = [&](const std::string& loop, const std::string& footprint) {
    const auto scenario = parse_scenario(head + loop, "my.yaml");
    return parse_scenario(to_yaml_as_stated(scenario),
                          {"again.yaml", {}, {}, {"vehicle.footprint=" + footprint}});
  };
  EXPECT_EQ(changed("", "rectangle").loop.sm_crash, 0);
  EXPECT_EQ(changed("", "point").loop.sm_crash, 2);
  EXPECT_EQ(changed("loop: {sm_crash: 2}\n", "rectangle").loop.sm_crash, 2);
  const auto once = changed("", "rectangle");
  EXPECT_EQ(to_yaml(parse_scenario(to_yaml_as_stated(once), "twice.yaml")), to_yaml(once));
}

/// The message with which a scenario of this obstacle, in line 5 from column 5 on, is refused.
std::string refusal(const std::string& obstacle) {
  try {
    (void)obstacle_of(obstacle);
  } catch (const InvalidValue& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BadObstacle, PlacesAndSizes) {
  EXPECT_EQ(refusal("{x: 5, y: 20}"),
            "my.yaml:5:5: found an obstacle without size, expected r, or a and b, or length and "
            "width, or a polygon");
  EXPECT_EQ(refusal("{r: 2}"),
            "my.yaml:5:5: found an obstacle without place, expected x and y, or a table, or a "
            "path");
  EXPECT_EQ(refusal("{x: 5, y: 20, length: 3}"),
            "my.yaml:5:5: found an obstacle with 1 of length, width, expected all of them");
  EXPECT_EQ(refusal("{x: 5, y: 20, r: 1, length: 3, width: 1}"),
            "my.yaml:5:5: found an obstacle with more than one size, expected r, or a and b, or "
            "length and width, or a polygon");
  EXPECT_EQ(refusal("{x: 5, y: 20, length: 0, width: 1}"),
            "my.yaml:5:27: found length = 0, expected a number > 0");
  EXPECT_EQ(refusal("{r: 1, vx: 3, table: [[0, 5, 20], [1, 6, 20]]}"),
            "my.yaml:5:16: found an obstacle with table and vx, expected table alone, which says "
            "where it is");
  EXPECT_EQ(refusal("{x: 5, y: 20, r: 1, speed: 2}"),
            "my.yaml:5:32: found an obstacle with speed alone, expected path beside it");
  EXPECT_EQ(refusal("{x: 5, y: 20, r: 1, after: stands}"),
            "my.yaml:5:32: found an obstacle with after alone, expected table beside it");
}

TEST(BadObstacle, Polygons) {
  const auto polygon = [](const std::string& corners) {
    return refusal("{x: 5, y: 20, polygon: " + corners + "}");
  };
  EXPECT_EQ(polygon("[[0, 0], [1, 1], [2, 2]]"),
            "my.yaml:5:28: found a polygon of no area, expected corners that are not on one line");
  EXPECT_EQ(polygon("[[0, 0], [4, 0], [1, 1], [0, 4]]"),
            "my.yaml:5:28: found a polygon that is not convex at (1, 1), expected a convex one; "
            "several convex ones may cover it");
  EXPECT_EQ(polygon("[[0, 0], [4, 0]]"),
            "my.yaml:5:28: found a polygon with 2 corners, expected three or more");
  EXPECT_EQ(polygon("[[0, 0], [4, 0, 2], [1, 1]]"),
            "my.yaml:5:37: found a corner with 3 numbers, expected 2 as in the first");
  EXPECT_EQ(polygon("[[0, 0], [.nan, 0], [1, 1]]"),
            "my.yaml:5:38: found '.nan', expected a finite number");
}

TEST(BadObstacle, Tables) {
  const auto table = [](const std::string& rows) { return refusal("{r: 1, table: " + rows + "}"); };
  EXPECT_EQ(table("[[0, 5, 20], [1, 6, 20], [1, 7, 20]]"),
            "my.yaml:5:5: row 3: found t = 1 after 1, expected times that rise");
  EXPECT_EQ(table("[[0, 5, 20], [1, 6, 20], [0.5, 7, 20]]"),
            "my.yaml:5:5: row 3: found t = 0.5 after 1, expected times that rise");
  EXPECT_EQ(table("[[0, 5, 20]]"),
            "my.yaml:5:5: found a table with 1 row, expected two or more; an obstacle that stands "
            "needs no table");
  EXPECT_EQ(table("[[0, 5, .nan], [1, 6, 20]]"),
            "my.yaml:5:27: found '.nan', expected a finite number");
  EXPECT_EQ(table("[[0, 5], [1, 6]]"),
            "my.yaml:5:20: found a row of a table with 2 numbers, expected t, x, y, psi (or "
            "without)");
  EXPECT_EQ(table("[[0, 5, 20], [1, 6, 20, 0]]"),
            "my.yaml:5:32: found a row of a table with 4 numbers, expected 3 as in the first");
  EXPECT_EQ(table("{t: 0}"),
            "my.yaml:5:19: found a map, expected a list of a row of a table, or the name of a CSV "
            "file with such");
}

TEST(BadObstacle, Paths) {
  EXPECT_EQ(refusal("{r: 1, path: [[5, 20], [6, 20]]}"),
            "my.yaml:5:18: found an obstacle with path alone, expected speed beside it");
  EXPECT_EQ(refusal("{r: 1, path: [[5, 20]], speed: 1}"),
            "my.yaml:5:5: found a path of 1 point, expected two or more");
  EXPECT_EQ(refusal("{r: 1, path: [[5, 20], [5, 20]], speed: 1}"),
            "my.yaml:5:5: found a path with points 1 and 2 at one place, expected places that "
            "differ");
  EXPECT_EQ(refusal("{r: 1, path: [[5, 20], [5, 25]], speed: -1}"),
            "my.yaml:5:45: found speed = -1, expected a number >= 0");
}

TEST(BadObstacle, WhatATableOrAPolygonSaysIsNotSetOnTheCommandLine) {
  const auto set = [](const std::string& assignment) -> std::string {
    try {
      (void)parse_scenario(kHead + kAll, {"my.yaml", {}, {}, {assignment}});
    } catch (const InvalidValue& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(set("obstacles.car.a=3"),
            "--set obstacles.car.a: found obstacle car a = 3, expected none, for the polygon says "
            "it");
  EXPECT_EQ(set("obstacles.traffic.x=3"),
            "--set obstacles.traffic.x: found obstacle traffic x = 3, expected none, for the table "
            "or path says it");
  EXPECT_EQ(set("obstacles.car.x=6"), "accepted");
  EXPECT_EQ(set("obstacles.walker.r=0.5"), "accepted");
}

/// The message for a table in a file beside the scenario, both without their folder.
std::string refusal_of_file(const std::string& csv) {
  TemporaryFolder folder;
  if (!csv.empty()) test::write(folder / "t.csv", csv);
  test::write(folder / "my.yaml", kHead + "  - {r: 1, table: t.csv}\n");
  std::string message = "accepted";
  try {
    load_scenario({folder / "my.yaml", {}, {}, {}});
  } catch (const InvalidValue& error) {
    message = error.what();
  }
  const auto prefix = folder.path().string() + "/";
  for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
    message.erase(at, prefix.size());
  return message;
}

TEST(BadObstacle, TablesInFiles) {
  EXPECT_EQ(refusal_of_file("t,x\n0,5\n1,6\n"),
            "t.csv:1: found no column y, expected a first line with the columns t, x, y, psi (or "
            "without)");
  EXPECT_EQ(refusal_of_file("t,x,y\n0,5,20\n1,6\n"),
            "t.csv:3: found too few cells, expected a finite number");
  EXPECT_EQ(refusal_of_file("t,x,y\n0,5,20\n1,nan,20\n"),
            "t.csv:3: found 'nan', expected a finite number");
  EXPECT_EQ(refusal_of_file("t,x,y\n0,5,20\n0,6,20\n"),
            "my.yaml:5:5: t.csv: row 2: found t = 0 after 0, expected times that rise");
  EXPECT_EQ(refusal_of_file("t,x,y\n"),
            "my.yaml:5:5: t.csv: found a table with 0 rows, expected two or more; an obstacle that "
            "stands needs no table");
  EXPECT_NE(refusal_of_file("").find("t.csv: found no such file"), std::string::npos);
  EXPECT_NE(refusal_of_file(std::string("t,x,y\n\0\1\2", 9)), "accepted");
}

}  // namespace
}  // namespace slalom::io
