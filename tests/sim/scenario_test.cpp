#include "slalom/sim/scenario.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <set>

#include "sim/fakes.hpp"
#include "slalom/base/error.hpp"

namespace slalom::sim {
namespace {

std::optional<InvalidValue> refusal(const std::function<void(Scenario&)>& change) {
  Scenario s = testing::open_field();
  s.obstacles = {testing::circle("O1", 3, 30, 4)};
  change(s);
  try {
    check(s, "E.yaml");
  } catch (const InvalidValue& error) {
    return error;
  }
  return std::nullopt;
}

std::string message(const std::function<void(Scenario&)>& change) {
  const auto refused = refusal(change);
  return refused ? refused->what() : "accepted";
}

void expect_refused(const std::function<void(Scenario&)>& change, const std::string& part) {
  const auto text = message(change);
  EXPECT_EQ(text.rfind("E.yaml", 0), 0u) << text;
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Scenario, DefaultsAndLimitsAreAccepted) {
  EXPECT_EQ(message([](Scenario&) {}), "accepted");
  EXPECT_EQ(message([](Scenario& s) {
              s.start[vehicle::UX] = 29;
              s.start[vehicle::AX] = -.5;
            }),
            "accepted");
  EXPECT_EQ(message([](Scenario& s) { s.loop.tex = 10; }), "accepted");
  EXPECT_EQ(message([](Scenario& s) { s.region.x_min = 0; }), "accepted");
  // On the grown edge is outside.
  EXPECT_EQ(message([](Scenario& s) { s.obstacles[0] = testing::circle("O1", 6, 0, 4); }),
            "accepted");
}

TEST(Scenario, StartOutsideItsBoundsIsRefused) {
  expect_refused(
      [](Scenario& s) {
        s.start[vehicle::PSI] = 7.5;
        s.vehicle.psi_max = 1;
      },
      "start: found psi = 7.5, expected");
  expect_refused([](Scenario& s) { s.start[vehicle::SA] = -.6; }, "start: found sa = -0.6");
  expect_refused([](Scenario& s) { s.start[vehicle::UX] = 29.5; }, "start: found ux = 29.5");
  expect_refused([](Scenario& s) { s.start[vehicle::UX] = -0.1; }, "start: found ux = -0.1");
  expect_refused([](Scenario& s) { s.start[vehicle::AX] = 2; }, "start: found ax = 2");
  expect_refused([](Scenario& s) { s.start[vehicle::AX] = -6; }, "start: found ax = -6");
  expect_refused([](Scenario& s) { s.region.x_min = .5; }, "start: found x = 0");
  expect_refused([](Scenario& s) { s.region.y_max = -1; }, "start: found y = 0");
  expect_refused(
      [](Scenario& s) {
        s.vehicle.footprint = vehicle::FootprintKind::rectangle;
        s.region.x_min = -0.5;
      },
      "its footprint 0.5 m outside the region");
  expect_refused([](Scenario& s) { s.start[vehicle::V] = kNaN; }, "start: found v = nan");
  expect_refused([](Scenario& s) { s.loop.Fz_failure = 6500; }, "Fz_r");
}

TEST(Scenario, AModelThatHoldsTheSpeedIsRefusedFromRest) {
  const auto held = [](double ux, double ax) {
    return [ux, ax](Scenario& s) {
      s.planner.model = vehicle::ModelKind::constant_speed;
      s.vehicle.ux_min = 0.01;
      s.start[vehicle::UX] = ux;
      s.start[vehicle::AX] = ax;
    };
  };
  EXPECT_EQ(message(held(10, 0)), "accepted");
  expect_refused(held(0, 0),
                 "start: found ux = 0, expected more than 0, for planner model constant_speed");
  expect_refused(held(10, 0.5),
                 "start: found ax = 0.5, expected 0, for planner model constant_speed");
}

TEST(Scenario, NoiseHasBounds) {
  using S = SensingSettings;
  for (const auto noise : {&S::position_noise, &S::heading_noise, &S::speed_noise,
                           &S::yaw_rate_noise, &S::obstacle_position_noise})
    expect_refused([&](Scenario& s) { s.sensing.*noise = 1e7; }, "noise = 10000000, expected");
  expect_refused([](Scenario& s) { s.sensing.obstacle_velocity_factor = -1e4; },
                 "obstacle_velocity_factor = -10000, expected");
}

TEST(Scenario, APlannerThatVerifiesLessThanADriveFailsByIsRefused) {
  const auto verified = [](auto change) {
    return [change](Scenario& s) {
      s.planner.method = planner::Method::verified;
      change(s);
    };
  };
  EXPECT_EQ(message(verified([](Scenario&) {})), "accepted");
  expect_refused(verified([](Scenario& s) { s.loop.sm_crash = 2.1; }),
                 "planner: found kept_clearance = 2.05, expected at least sm_crash = 2.1");
  expect_refused(verified([](Scenario& s) { s.loop.Fz_failure = 300; }),
                 "planner: found kept_wheel_load = 200, expected at least Fz_failure = 300");
  expect_refused(verified([](Scenario& s) {
                   s.planner.kept_wheel_load = 500;
                   s.loop.Fz_failure = 450;
                 }),
                 "planner: found verified_wheel_load = 400");
  expect_refused(verified([](Scenario& s) {
                   s.loop.sm_crash = 0.2;
                   s.vehicle.footprint = vehicle::FootprintKind::rectangle;
                 }),
                 "loop: found sm_crash = 0.2, expected 0");
}

TEST(Scenario, StartInsideAGrownObstacleIsRefused) {
  expect_refused([](Scenario& s) { s.obstacles[0] = testing::circle("O1", 5.9, 0, 4); },
                 "inside obstacle O1 grown by sm_crash = 2 m");
  expect_refused([](Scenario& s) { s.obstacles[0] = {"O2", 0, 4.9, 50, 3, 0, 0}; }, "O2");
}

/// 4 m long, 2 m wide, turned by half a right angle.
world::Obstacle turned_box(double x, double y) {
  const auto box = world::Polygon::rectangle(4, 2);
  world::Obstacle o{"box", x, y};
  o.a = o.b = box.reach();
  o.outline = std::make_shared<world::Polygon>(box);
  o.psi = std::numbers::pi / 4;
  return o;
}

TEST(Scenario, StartsAndGoalsAreJudgedByExactShapes) {
  // The box's corner that is nearest to the start lies (-1, -3) / sqrt(2) off its middle.
  const auto near = [](double margin) {
    return [margin](Scenario& s) {
      s.loop.sm_crash = margin;
      s.obstacles[0] = turned_box(1 / std::sqrt(2), 3 / std::sqrt(2) + 1);
    };
  };
  EXPECT_EQ(message(near(0.99)), "accepted");
  expect_refused(near(1.01), "0.01 m inside obstacle box grown by sm_crash = 1.01 m");
  const auto with_body = [&](double margin) {
    return [=](Scenario& s) {
      near(margin)(s);
      s.vehicle.footprint = vehicle::FootprintKind::rectangle;
    };
  };
  EXPECT_EQ(message(with_body(0.35)), "accepted");  // the body reaches 0.649 m ahead
  expect_refused(with_body(0.36), "its footprint 0.009 m inside obstacle box");
  expect_refused([](Scenario& s) { s.obstacles[0] = turned_box(s.goal.x, s.goal.y + 3); },
                 "m inside obstacle box grown by sm_end = 4 m");
  // What is absent at the start is not in its way; what moves may be gone from the goal.
  const auto by_table = [](double from) {
    return [from](Scenario& s) {
      auto box = turned_box(0, 0);
      box.x = box.y = box.psi = 0;
      box.trajectory = std::make_shared<world::TableTrajectory>(
          std::vector<world::TrajectoryRow>{{from, 0, 0}, {9, s.goal.x, s.goal.y}},
          world::BeyondEnd::absent, world::BeyondEnd::stands, "box");
      s.obstacles[0] = box;
    };
  };
  EXPECT_EQ(message(by_table(1)), "accepted");
  expect_refused(by_table(0), "inside obstacle box");
}

TEST(Scenario, WhatAPolygonOrATableSaysIsNotSetBesideIt) {
  expect_refused(
      [](Scenario& s) {
        s.obstacles[0] = turned_box(50, 50);
        s.obstacles[0].b = 3;
      },
      "obstacle box: found b = 3, expected none, for the polygon says it");
  expect_refused(
      [](Scenario& s) {
        s.obstacles[0].trajectory =
            std::make_shared<world::TurningTrajectory>(0, world::Pose{50, 50});
        s.obstacles[0].x = s.obstacles[0].y = 0;
        s.obstacles[0].vx = 3;
      },
      "found vx = 3, expected none, for the table or path says it");
}

TEST(Scenario, WhatIsVerifiedMayEndBesideWhatStandsInTheMiddleOfTheGoal) {
  const auto with = [](double r) {
    return [r](Scenario& s) {
      s.planner.method = planner::Method::verified;
      s.planner.verified_clearance = s.planner.kept_clearance = 2.15;
      s.obstacles[0] = testing::circle("cone", s.goal.x, s.goal.y, r);
    };
  };
  EXPECT_EQ(message(with(0.4)), "accepted");
  expect_refused(with(30), "inside obstacle cone grown by verified_clearance = 2.15 m");
}

TEST(Scenario, AGoalThatNoPlanMayEndAtIsRefused) {
  expect_refused(
      [](Scenario& s) { s.obstacles[0] = testing::circle("blob", s.goal.x, s.goal.y + 5, 2); },
      "goal: found (0, 1000), 1 m inside obstacle blob grown by sm_end = 4 m");
  expect_refused(
      [](Scenario& s) {
        s.obstacles[0] = testing::circle("blob", s.goal.x, s.goal.y + 10, 2);
        s.obstacles[0].margin_start = 5;
      },
      "1 m inside obstacle blob grown by sm_end = 4 m and margin_start = 5 m");
  expect_refused([](Scenario& s) { s.region.y_max = 900; }, "a goal within the region");
  EXPECT_EQ(message([](Scenario& s) {
              s.obstacles[0] = testing::circle("passes", s.goal.x, s.goal.y, 2, 1);
            }),
            "accepted");
}

TEST(Scenario, ObstaclesGoalAndRegionAreChecked) {
  expect_refused([](Scenario& s) { s.obstacles[0].a = 0; }, "obstacle O1: found a = 0");
  expect_refused([](Scenario& s) { s.obstacles[0].b = -4; }, "obstacle O1: found b = -4");
  expect_refused([](Scenario& s) { s.obstacles[0].vy = kNaN; }, "obstacle O1: found vy = nan");
  expect_refused([](Scenario& s) { s.obstacles[0].x = 1 / 0.; }, "obstacle O1: found x = inf");
  expect_refused([](Scenario& s) { s.goal.sigma = 0; },
                 "goal: found sigma = 0, expected a number > 0");
  expect_refused([](Scenario& s) { s.goal.y = kNaN; }, "goal: found y = nan");
  expect_refused([](Scenario& s) { s.goal.psi = kNaN; }, "goal: found psi = nan");
  expect_refused(
      [](Scenario& s) {
        s.region.x_min = 3;
        s.region.x_max = 2;
      },
      "region");
  expect_refused([](Scenario& s) { s.region.y_min = kNaN; }, "region");
}

TEST(Scenario, SettingsOfEveryPartAreChecked) {
  expect_refused([](Scenario& s) { s.loop.tex = 0; }, "tex = 0");
  expect_refused([](Scenario& s) { s.loop.tex = -.5; }, "tex = -0.5");
  expect_refused([](Scenario& s) { s.loop.tex = kNaN; }, "tex = nan");
  expect_refused([](Scenario& s) { s.loop.tex = 10.5; },
                 "tex = 10.5, expected at most tf_max = 10");
  expect_refused([](Scenario& s) { s.loop.timeout = 0; }, "timeout = 0");
  expect_refused([](Scenario& s) { s.loop.solve_time_limit = -1; }, "solve_time_limit");
  expect_refused([](Scenario& s) { s.loop.plant_tolerance = 1e-3; }, "plant_tolerance");
  expect_refused([](Scenario& s) { s.loop.sample_step = .1; }, "sample_step");
  expect_refused([](Scenario& s) { s.planner.kappa = 60; }, "L_range");
  expect_refused([](Scenario& s) { s.vehicle.Izz = 0; }, "Izz = 0");
}

/// Keys of the values at fault.
std::vector<std::string> keys(const std::function<void(Scenario&)>& change) {
  const auto refused = refusal(change);
  return refused ? refused->keys() : std::vector<std::string>();
}

TEST(Scenario, RefusalsHaveTheKeysOfTheValuesAtFault) {
  using Keys = std::vector<std::string>;
  EXPECT_EQ(keys([](Scenario& s) { s.goal.sigma = 0; }), Keys{"goal.sigma"});
  EXPECT_EQ(keys([](Scenario& s) { s.obstacles[0].a = 0; }), Keys{"obstacles.O1.a"});
  EXPECT_EQ(keys([](Scenario& s) { s.start[vehicle::V] = kNaN; }), Keys{"start.v"});
  EXPECT_EQ(keys([](Scenario& s) { s.vehicle.Izz = 0; }), Keys{"vehicle.Izz"});
  EXPECT_EQ(keys([](Scenario& s) { s.planner.N = 0; }), Keys{"planner.N"});
  EXPECT_EQ(keys([](Scenario& s) { s.loop.timeout = 0; }), Keys{"loop.timeout"});
  EXPECT_EQ(keys([](Scenario& s) { s.plant.mass_factor = 0; }), Keys{"plant.mass_factor"});
  EXPECT_EQ(keys([](Scenario& s) { s.sensing.delay = -1; }), Keys{"sensing.delay"});
  EXPECT_EQ(keys([](Scenario& s) { s.loop.latency = LatencyRule::recorded; }),
            (Keys{"loop.latency", "loop.solve_times"}));
  EXPECT_EQ(keys([](Scenario& s) { s.loop.tex = 10.5; }), (Keys{"loop.tex", "planner.tf_max"}));
  EXPECT_EQ(keys([](Scenario& s) { s.planner.kappa = 60; }),
            (Keys{"planner.L_range", "planner.kappa"}));
  EXPECT_EQ(keys([](Scenario& s) { s.vehicle.ux_min = 30; }),
            (Keys{"vehicle.ux_min", "vehicle.ux_max"}));
  EXPECT_EQ(keys([](Scenario& s) { s.region.x_max = s.region.x_min; }),
            (Keys{"region.x_min", "region.x_max"}));
  EXPECT_EQ(keys([](Scenario& s) { s.region.y_max = -1; }), (Keys{"start.y", "region.y_max"}));
  EXPECT_EQ(keys([](Scenario& s) { s.plant.cg_shift = 2; }),
            (Keys{"plant.cg_shift", "vehicle.la", "vehicle.lb"}));
  // What the plant's factors make of the vehicle.
  EXPECT_EQ(keys([](Scenario& s) {
              s.vehicle.m = 1e308;
              s.plant.mass_factor = 10;
              s.plant.actuator_delay = 1;
            }),
            (Keys{"plant.mass_factor", "vehicle.m"}));
  EXPECT_EQ(keys([](Scenario& s) { s.obstacles[0] = testing::circle("O1", 5.9, 0, 4); }),
            (Keys{"start", "obstacles.O1", "loop.sm_crash"}));
}

TEST(Scenario, DriveRefusesWhatCheckRefuses) {
  auto s = testing::open_field();
  s.loop.tex = -1;
  EXPECT_THROW((void)drive(s, testing::straight_on), InvalidValue);
}

TEST(Scenario, EveryLoopOptionHasADocAndADefaultWithinItsRange) {
  std::set<std::string> names;
  const LoopSettings defaults;
  for (const auto& entry : loop_options().entries()) {
    EXPECT_TRUE(names.insert(entry.info.name).second);
    EXPECT_FALSE(entry.info.doc.empty());
    EXPECT_NO_THROW((void)entry.info.checked(entry.get(defaults), "defaults")) << entry.info.name;
  }
  LoopSettings loop;
  loop_options().set(loop, *loop_options().find("on_failure"), std::string("last_plan"), "test");
  EXPECT_EQ(loop.on_failure, OnFailure::last_plan);
}

}  // namespace
}  // namespace slalom::sim
