#include "slalom/sim/marks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <functional>
#include <numbers>

#include "sim/fakes.hpp"
#include "slalom/vehicle/derived.hpp"

namespace slalom::sim {
namespace {

using testing::open_field;
using testing::straight_on;

std::vector<std::string> kinds(const std::vector<Mark>& marks) {
  std::vector<std::string> result;
  for (const auto& mark : marks) result.push_back(mark.kind);
  return result;
}

using Kinds = std::vector<std::string>;

TEST(Marks, ADriveThatIsAsPlannedHasNone) {
  const auto s = open_field();
  EXPECT_EQ(kinds(marks(s, drive(s, straight_on))), Kinds{});
}

TEST(Marks, APlanThatBeginsBesideTheVehicleIsNamedByItsFarthest) {
  const auto s = open_field();
  int cycle = 0;
  const auto beside = [&](const planner::Request& request) {
    auto plan = straight_on(request);
    ++cycle;
    if (cycle == 3) plan.states[0][vehicle::X] -= 0.3;
    if (cycle == 5) plan.states[0][vehicle::PSI] += 0.1;
    if (cycle == 7) plan.states[0][vehicle::Y] += 0.09;  // not worth it
    return plan;
  };
  const auto driven = drive(s, beside);
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), Kinds{"start_slack"});
  EXPECT_EQ(found[0].times,
            (std::vector<double>{driven.cycles[2].t_swap, driven.cycles[4].t_swap}));
  EXPECT_EQ(found[0].text,
            "2 plans begin beside the vehicle, by up to 0.00 m and 5.7 degrees (cycle 5)");
  EXPECT_NEAR(start_slack(driven.cycles[2]).distance, 0.3, 1e-12);
}

TEST(Marks, APlanThroughAnObstacleIsNamedByItsDeepest) {
  const auto s = open_field();
  const auto through = [&](const planner::Request& request) {
    auto plan = straight_on(request);
    plan.report.status = planner::PlanStatus::passes_through;
    plan.report.passage = {request.t0 == 1 ? 2.0 : 0.7, "lorry", request.t0 + 3};
    return plan;
  };
  const auto driven = drive(s, through);
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), Kinds{"passes_through"});
  EXPECT_EQ(found[0].times.size(), driven.cycles.size());
  EXPECT_NE(found[0].text.find("2.00 m into the margin of lorry at 4.00 s (cycle 3)"),
            std::string::npos)
      << found[0].text;
}

TEST(Marks, PlansThatSoftRowsLetInAreToldFromThoseThatPassUnseen) {
  const auto s = open_field();
  const auto in = [&](const planner::Request& request) {
    auto plan = straight_on(request);
    plan.report.status = planner::PlanStatus::passes_through;
    plan.report.passage = {2.0, "lorry", request.t0 + 3, request.t0 == 1 ? 0.4 : 1.8};
    if (request.t0 == 2) plan.report.passage.depth = 3;
    return plan;
  };
  const auto driven = drive(s, in);
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), (Kinds{"passes_through", "soft_obstacle"}));
  EXPECT_EQ(found[0].times,
            (std::vector<double>{driven.cycles[2].t_swap, driven.cycles[4].t_swap}));
  EXPECT_EQ(found[1].times.size(), driven.cycles.size() - 2);
  EXPECT_NE(found[1].text.find("8 plans go into an obstacle as its soft rows allow, the deepest "
                               "2.00 m into the margin of lorry at 3.00 s (cycle 1)"),
            std::string::npos)
      << found[1].text;
}

TEST(Marks, APlanOffItsRoadIsNamedByItsFarthest) {
  const auto s = open_field();
  const auto off = [&](const planner::Request& request) {
    auto plan = straight_on(request);
    plan.report.status = planner::PlanStatus::passes_through;
    plan.report.passage.depth = s.planner.passage_depth;  // as deep as it may
    plan.report.road_exit = {request.t0 == 1 ? 0.4 : 0.1, request.t0 == 1, request.t0 + 3};
    return plan;
  };
  const auto driven = drive(s, off);
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), Kinds{"plan_off_road"});
  EXPECT_EQ(found[0].times.size(), driven.cycles.size());
  EXPECT_NE(found[0].text.find("plans leave the road between nodes, the farthest by 0.40 m at its "
                               "left edge at 4.00 s (cycle 3)"),
            std::string::npos)
      << found[0].text;
}

TEST(Marks, LimitsThatThePlantBreaksAreNamedOnceForEachWhile) {
  auto s = open_field();
  auto driven = drive(s, straight_on);
  driven.plant.resize(10);
  for (std::size_t k : {2, 3, 6}) driven.plant[k].wheel_loads[1] = k == 3 ? 269 : 700;
  for (std::size_t k : {4, 5}) driven.plant[k].state[vehicle::UX] = 29.5;
  s.region.x_max = 3;
  driven.plant[8].state[vehicle::X] = 3.4;
  driven.plant[9].state[vehicle::X] = 3.05;  // within what is not worth it
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), (Kinds{"wheel_load", "speed", "region"}));
  EXPECT_EQ(found[0].times, (std::vector<double>{driven.plant[2].t, driven.plant[6].t}));
  EXPECT_NE(found[0].text.find("fell to 269 N"), std::string::npos) << found[0].text;
  EXPECT_EQ(found[1].times.size(), 1u);
  EXPECT_NE(found[2].text.find("0.40 m outside"), std::string::npos) << found[2].text;
}

TEST(Marks, ABodyUponAnObstacleThatThePointKeepsOffIsNamed) {
  auto s = open_field();
  s.vehicle.front_overhang = 1;  // the rear end is 6 m behind the front axle
  s.vehicle.length = 7;
  s.vehicle.width = 2;
  // It comes from the side, to 2.1 m from the front axle's centre.
  s.obstacles = {testing::circle("far", 40, 40, 3),
                 testing::circle("crosser", 17.2, 30.8, 0.3, -8, 0)};
  const auto driven = drive(s, straight_on);
  ASSERT_EQ(driven.outcome, Outcome::timeout) << driven.message;
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), Kinds{"body_overlap"});
  ASSERT_EQ(found[0].times.size(), 1u);
  EXPECT_NEAR(found[0].times[0], (17.2 - 0.3 - 1) / 8, 0.03);
  EXPECT_NE(found[0].text.find("7 m by 2 m, was 1.0"), std::string::npos) << found[0].text;
  EXPECT_NE(found[0].text.find("m deep in crosser at "), std::string::npos) << found[0].text;
  s.vehicle.footprint = vehicle::FootprintKind::rectangle;
  EXPECT_EQ(kinds(marks(s, driven)), Kinds{}) << "a drive that is judged by its body";
}

/// The drive of a vehicle that is at these places.
Drive at_places(const std::function<world::Point(double)>& place, double until) {
  Drive driven;
  for (int k = 0; k * 0.02 <= until; ++k) {
    PlantSample sample;
    sample.t = k * 0.02;
    const world::Point p = place(sample.t);
    sample.state = {p.x, p.y, 0, 0, 0, 0, 10, 0};
    sample.wheel_loads.fill(5000);
    driven.plant.push_back(sample);
  }
  return driven;
}

TEST(Marks, AVehicleThatCirclesBeforeItsGoalIsNamed) {
  auto s = open_field();
  s.goal = {-80, 0, 0, 5};
  for (const double period : {6., 15.}) {
    const auto circle = [period](double t) {
      const double turned = 2 * std::numbers::pi * t / period;
      return world::Point{10 * std::sin(turned), 10 * (1 - std::cos(turned))};
    };
    EXPECT_EQ(kinds(marks(s, at_places(circle, 10))), Kinds{}) << period;
    const auto found = marks(s, at_places(circle, 40));
    ASSERT_EQ(kinds(found), Kinds{"moves_away"}) << period;
    EXPECT_EQ(found[0].times.size(), 1u);
    // Drifting towards the goal by 3 m a second it gets there.
    const auto drifts = [&](double t) { return circle(t) + world::Point{-3 * t, 0}; };
    EXPECT_EQ(kinds(marks(s, at_places(drifts, 25))), Kinds{}) << period;
  }
}

TEST(Marks, AVehicleThatWaitsDoesNotMoveAway) {
  auto s = open_field();
  s.goal = {100, 0, 0, 5};
  const auto waits = [](double t) {  // 30 s, then back by 4 m and past what stood there
    return world::Point{t < 30 ? 40 : t < 34 ? 70 - t : 36 + 6 * (t - 34), 0};
  };
  EXPECT_EQ(kinds(marks(s, at_places(waits, 44))), Kinds{});
}

TEST(Marks, AVehicleThatMovesAwayForTenSecondsIsNamed) {
  auto s = open_field();
  s.loop.timeout = 20;
  s.goal.y = 100;
  s.goal.x = 30;  // which it passes at 5.9 s
  const auto found = marks(s, drive(s, straight_on));
  ASSERT_EQ(kinds(found), Kinds{"moves_away"});
  EXPECT_NEAR(found[0].times.at(0), 100 / 17., 0.05);
  s.loop.timeout = 15;
  EXPECT_EQ(kinds(marks(s, drive(s, straight_on))), Kinds{});
}

// By the scenario's own planner, P_D.

TEST(MarksOfPlans, AGoalBehindTheVehicleIsDrivenAwayFrom) {
  Scenario s;
  s.name = "behind";
  s.vehicle.ux_max = 12;
  s.start = {0, 0, 0, 0, 0, 0, 6, 0};
  s.goal = {-40, 69.282, 2 * std::numbers::pi / 3, 5};
  s.loop.timeout = 20;
  const auto driven = drive(s);
  EXPECT_EQ(driven.outcome, Outcome::timeout) << driven.message;
  const auto found = marks(s, driven);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.back().kind, "moves_away");
  EXPECT_NEAR(found.back().times.at(0), 0, 0.5);
}

/// A car as a data sheet has it passes a parked one and one that comes. Its first plans begin off
/// its heading.
TEST(MarksOfPlans, PlansThatBeginBesideTheVehicleAreNamedAndItPasses) {
  Scenario s;
  s.name = "beside";
  auto& v = s.vehicle;
  v.m = 1350;
  v.Izz = 2100;
  v.la = 1.1;
  v.lb = 1.5;
  v.FzF0 = 7640;
  v.FzR0 = 5600;
  (void)vehicle::derive(v, {"m", "Izz", "la", "lb", "FzF0", "FzR0"});
  s.start = {0, 0, 0, 0, 0, 0, 20, 0};
  s.goal = {200, 0, 0, 5};
  s.region.y_min = -6;
  s.region.y_max = 8;
  s.obstacles = {{"car", 70, 0, 2.3, 0.9}, {"oncoming", 160, 3.5, 2.3, 0.9, -5, 0}};
  const auto driven = drive(s);
  EXPECT_EQ(driven.outcome, Outcome::goal) << driven.message;
  StartSlack most;
  for (const auto& cycle : driven.cycles)
    if (cycle.used) most.heading = std::max(most.heading, start_slack(cycle).heading);
  const double degrees = most.heading * 180 / std::numbers::pi;
  ASSERT_GT(degrees, 1);
  const auto found = marks(s, driven);
  const auto beside = std::find_if(found.begin(), found.end(),
                                   [](const Mark& mark) { return mark.kind == "start_slack"; });
  ASSERT_NE(beside, found.end());
  EXPECT_NE(beside->text.find(fmt::format(" m and {:.1f} degrees (cycle ", degrees)),
            std::string::npos)
      << beside->text;
}

}  // namespace
}  // namespace slalom::sim
