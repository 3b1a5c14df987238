#include "../../src/planner/verifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Northwards at 20 m/s from the origin, for 5 s; the goal's square begins 85 m ahead.
struct Scene : ::testing::Test {
  Task task;
  Motion motion;
  Need need{2.15, 400};

  Scene() {
    task.vehicle.tyre_asymmetry = false;
    task.goal = {0, 100, std::numbers::pi / 2, 15};
    drive(20);
  }
  /// Straight on with knots .05 s apart.
  void drive(double speed, double jerk = 0) {
    const Plant plant(task.vehicle, 1e-9, 0.02);
    motion = {};
    State x = {0, 0, 0, 0, std::numbers::pi / 2, 0, speed, 0};
    for (int k = 0; k <= 100; ++k) {
      const double t = 1 + 0.05 * k;
      motion.add(t, x, {0, jerk});
      x = plant.advance(x, {0, jerk}, {0, jerk}, t, t + 0.05);
    }
  }
  Verdict judge(const std::vector<world::Obstacle>& obstacles = {}, double tex = 0.5,
                double late = 0) {
    const Plant plant(task.vehicle, 1e-9, 0.02);
    return Verifier(task, plant).judge(motion, obstacles, need, {motion.begin() + late, tex});
  }
};

TEST_F(Scene, AMotionThatArrivesIsVerified) {
  const Verdict verdict = judge();
  EXPECT_TRUE(verdict.certificate.verified) << verdict.certificate.refused;
  EXPECT_EQ(verdict.end, MotionEnd::arrives);
  EXPECT_NEAR(verdict.arrival, 1 + 85 / 20., 0.06);
  EXPECT_NEAR(verdict.certificate.least_wheel_load, 12696 / 2., 1);
  EXPECT_DOUBLE_EQ(verdict.certificate.until, 6);
}

TEST_F(Scene, ACentimetreTooNearIsRefusedAndACentimetreFartherIsNot) {
  for (const double spare : {-0.01, 0.01}) {
    const double r = 3, x = r + 2.15 + spare;
    const Verdict verdict = judge({{"O1", x, 50, r, r, 0, 0}});
    EXPECT_EQ(verdict.certificate.verified, spare > 0) << spare;
    EXPECT_NEAR(verdict.certificate.least_clearance, 2.15 + spare, 0.011);
    EXPECT_EQ(verdict.certificate.nearest, "O1");
    if (spare < 0) {
      EXPECT_NE(verdict.certificate.refused.find("O1"), std::string::npos);
      EXPECT_NEAR(verdict.certificate.refused_at, 3.5, 0.3);
    }
  }
}

// At 80 m/s of closing speed the two are 4 m apart from knot to knot.
TEST_F(Scene, SeesWhatPassesBetweenTwoKnots) {
  for (const double spare : {-0.01, 0.01, 2.0}) {
    const double r = 0.2, x = r + 2.15 + spare;
    const double meet = 3.525;  // half-way between two knots
    const double y = 20 * (meet - 1) + 60 * meet;
    const Verdict verdict = judge({{"O2", x, y, r, r, 0, -60}});
    EXPECT_EQ(verdict.certificate.verified, spare > 0) << spare;
    if (spare < 1) continue;
    EXPECT_GT(verdict.certificate.least_clearance, 2.15 + spare + 0.1) << "at the knots";
    EXPECT_EQ(verdict.certificate.proved_clearance, 2.15) << "and between them";
  }
}

TEST_F(Scene, AnEllipsesDistanceIsTheExactOne) {
  for (const double spare : {-0.01, 0.01}) {
    const Verdict verdict = judge({{"O3", 12 + 2.15 + spare, 50, 12, 1, 0, 0}});
    EXPECT_EQ(verdict.certificate.verified, spare > 0) << spare;
  }
}

TEST_F(Scene, RefusesWhatLeavesTheRegionOrTheLimits) {
  task.region.y_max = 90;
  EXPECT_NE(judge().certificate.refused.find("region"), std::string::npos);
  task.region.y_max = 200;
  task.vehicle.ux_max = 19;
  EXPECT_NE(judge().certificate.refused.find("speed"), std::string::npos);
  task.vehicle.ux_max = 29;
  drive(20, -0.2);  // its rear wheels lose load
  need.wheel_load = judge().certificate.least_wheel_load + 10;
  EXPECT_NE(judge().certificate.refused.find("wheel load"), std::string::npos)
      << judge().certificate.refused;
  need.wheel_load = 400;
  drive(20, 2);
  EXPECT_NE(judge().certificate.refused.find("acceleration"), std::string::npos);
}

// Braking goes and comes again within an interval: at its ends the loads are the same.
TEST_F(Scene, FindsALoadThatDipsBetweenTwoKnots) {
  const Plant plant(task.vehicle, 1e-9, 0.02);
  const Motion steady = motion;
  motion = part_before(steady, 2);
  const State from = motion.states.back();
  motion.controls.back() = {0, -5};
  const double begin = motion.end(), length = 0.5;
  State x = plant.advance(from, {0, -5}, {0, 5}, begin, begin + length);
  for (int k = 0; k <= 80; ++k) {
    motion.add(begin + length + 0.05 * k, x, k == 0 ? Control{0, 5} : Control{});
    x = plant.advance(x, motion.controls.back(), {}, motion.end(), motion.end() + 0.05);
  }
  const double whole = judge().certificate.least_wheel_load;
  const State middle = plant.advance(from, {0, -5}, {0, 0}, begin, begin + length / 2);
  const WheelLoads dip = plant.dynamics().wheel_loads(middle);
  const double least = *std::min_element(dip.begin(), dip.end());
  ASSERT_LT(least, whole - 200) << "at its knots the motion has more";
  for (const double spare : {-10, 10}) {
    need.wheel_load = least - spare;
    const Verdict verdict = judge();
    EXPECT_EQ(verdict.certificate.verified, spare > 0) << verdict.certificate.refused;
    EXPECT_NEAR(verdict.certificate.least_wheel_load, least, 11);
  }
}

TEST_F(Scene, AMotionThatBeginsBeyondALimitHasAWhileToComeBack) {
  task.vehicle.ux_max = 19.8;
  task.goal.y = 60;
  drive(20, -0.5);  // below it after .9 s
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
  drive(20);
  EXPECT_NEAR(judge().certificate.refused_at, 2, 0.06) << "it does not come back";
  drive(20, 0.5);
  EXPECT_NEAR(judge().certificate.refused_at, 1, 0.06) << "it goes further";
}

TEST_F(Scene, ArrivesOnlyWhereTheLoopLooks) {
  // Within the square from 4.25 s after the start on; looks every 2.2 s find it outside at 5.4 s
  // on.
  EXPECT_EQ(judge({}, 2.2).end, MotionEnd::arrives);
  task.goal.sigma = 3;  // 97 to 103 m: within it from 5.85 s on
  EXPECT_EQ(judge({}, 0.5).end, MotionEnd::arrives);
  EXPECT_EQ(judge({}, 1.2).end, MotionEnd::open);
  EXPECT_FALSE(judge({}, 1.2).certificate.verified);
  EXPECT_EQ(judge({}, 1.2, 0.1).end, MotionEnd::arrives) << "it looks at 5.9 s";
  EXPECT_EQ(judge({}, 1.2, 0.1 - 12).end, MotionEnd::arrives) << "the same looks";
  EXPECT_EQ(judge({}, 1.2, -0.1).end, MotionEnd::open);
}

TEST_F(Scene, MayStandOnlyWhereNothingComesForGood) {
  task.goal.y = 500;
  drive(0.1);
  EXPECT_EQ(judge().end, MotionEnd::stands);
  EXPECT_TRUE(judge().certificate.verified);
  // Here 40 s after the motion's end, within the horizon of 60 s.
  world::Obstacle late{"late", 0, 46 * 3., 1, 1, 0, -3};
  EXPECT_FALSE(judge({late}).certificate.verified);
  EXPECT_NE(judge({late}).certificate.refused.find("late"), std::string::npos);
  late.x = 3.3;  // passes at .15 m beyond what is needed
  EXPECT_TRUE(judge({late}).certificate.verified);
  task.planner.standing_horizon = 20;
  late.x = 0;
  EXPECT_TRUE(judge({late}).certificate.verified);
}

// The plant holds a motion's last control beyond its end.
TEST_F(Scene, MayStandOnlyWithoutControl) {
  task.goal.y = 500;
  drive(0.1);
  motion.controls.back()[JX] = 0.1;
  EXPECT_EQ(judge().end, MotionEnd::open);
  EXPECT_FALSE(judge().certificate.verified);
}

TEST_F(Scene, ABodyIsWithinTheRegionByItsCorners) {
  task.region.x_max = 0.9;
  EXPECT_TRUE(judge().certificate.verified);
  task.vehicle.footprint = FootprintKind::rectangle;
  EXPECT_NE(judge().certificate.refused.find("region"), std::string::npos);
  task.region.x_max = task.vehicle.width / 2 + 0.01;
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
}

// Northwards out of x <= -.3, and back.
TEST_F(Scene, WhatBeginsOutsideTheRegionReturns) {
  task.region.x_max = -0.3;
  EXPECT_NE(judge().certificate.refused.find("outside the region at 5 s"), std::string::npos)
      << "it stays outside: " << judge().certificate.refused;
  const Motion straight = motion;
  for (std::size_t k = 0; k < motion.size(); ++k)
    motion.states[k][X] = -0.2 * (motion.t[k] - motion.begin());
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
  motion = straight;
  for (std::size_t k = 0; k < motion.size(); ++k)
    motion.states[k][X] = 0.5 * (motion.t[k] - motion.begin());
  EXPECT_NEAR(judge().certificate.refused_at, 2, 0.1) << "half a metre further out";
  motion = straight;
  for (std::size_t k = 0; k < motion.size(); ++k) motion.states[k][X] = 0.2 * motion.t[k] - 0.6;
  EXPECT_NEAR(judge().certificate.refused_at, 1.5, 0.1) << "it begins inside";
}

TEST_F(Scene, StandsOnlyWhereItCreepsOnTheRoad) {
  task.goal.y = 500;
  drive(0.1);  // 6 m in the horizon of 60 s
  const auto road_of = [](double right) {
    return std::make_shared<world::Road>(
        std::vector<world::RoadPoint>{{0, -100, right, 4}, {0, 100, right, 4}}, false,
        std::vector<std::vector<world::Point>>{}, "road");
  };
  task.road = road_of(2);
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
  motion.states.back()[PSI] -= 0.4;  // it creeps to the right, 2.5 m in all
  EXPECT_NE(judge().certificate.refused.find("creeping off the road"), std::string::npos)
      << judge().certificate.refused;
  EXPECT_GT(judge().certificate.refused_at, motion.end() + 30);
  task.road = road_of(3);
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
}

// What creeps with its wheels turned goes round, not straight on.
TEST_F(Scene, StandsOnlyWhereItCreepsOnTheRoadAsItSteers) {
  task.goal.y = 500;
  drive(0.1);
  const auto road_of = [](double right) {
    return std::make_shared<world::Road>(
        std::vector<world::RoadPoint>{{0, -100, right, 4}, {0, 100, right, 4}}, false,
        std::vector<std::vector<world::Point>>{}, "road");
  };
  motion.states.back()[SA] = -0.35;  // 6 m along a circle of 9 m: to the right by 3.9 m in all
  task.road = road_of(3);
  EXPECT_NE(judge().certificate.refused.find("creeping off the road"), std::string::npos)
      << judge().certificate.refused;
  task.road = road_of(5);
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
  const double front = motion.states.back()[Y];
  task.road = nullptr;
  const world::Obstacle beside{"beside", 4.5, front + 4.5, 1, 1, 0, 0};
  EXPECT_NE(judge({beside}).certificate.refused.find("in the way"), std::string::npos)
      << judge({beside}).certificate.refused;
  motion.states.back()[SA] = 0;
  EXPECT_TRUE(judge({beside}).certificate.verified) << judge({beside}).certificate.refused;
}

// By the plant, driven on without control for the whole horizon.
TEST_F(Scene, WhatCreepsIsWhereThePlantIs) {
  task.goal.y = 500;
  drive(0.1);
  motion.states.back()[SA] = -0.35;
  const Plant plant(task.vehicle, 1e-9, 0.02);
  const double horizon = task.planner.standing_horizon;
  const State end =
      plant.advance(motion.states.back(), {}, {}, motion.end(), motion.end() + horizon);
  const double ahead = end[PSI] + std::atan2(end[V] + task.vehicle.la * end[R], end[UX]);
  for (const double spare : {-0.03, 0.03}) {
    const double distance = 1 + need.clearance + 0.01 + spare;  // looks are .01 m apart
    const world::Obstacle there{
        "there", end[X] + distance * std::cos(ahead), end[Y] + distance * std::sin(ahead), 1, 1, 0,
        0};
    EXPECT_EQ(judge({there}).certificate.verified, spare > 0) << judge({there}).certificate.refused;
  }
}

TEST_F(Scene, AccelerationThatIsLeftIsReckonedWith) {
  task.goal.y = 500;
  drive(0.1);
  const world::Obstacle ahead{"ahead", 0, 30, 1, 1, 0, 0};
  EXPECT_TRUE(judge({ahead}).certificate.verified) << judge({ahead}).certificate.refused;
  motion.states.back()[AX] = 0.019;  // 34 m further in the horizon of 60 s
  EXPECT_NE(judge({ahead}).certificate.refused.find("in the way"), std::string::npos)
      << judge({ahead}).certificate.refused;
}

TEST_F(Scene, StandsOnlyWhereItCreepsWithinWhatIsSeen) {
  task.goal.y = 500;
  drive(0.1);  // .5 m and then 6 m, and 2.15 m clear
  need.seen = {0, 0, 8};
  EXPECT_NE(judge().certificate.refused.find("out of what is seen"), std::string::npos)
      << judge().certificate.refused;
  need.seen.radius = 9;
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
}

TEST_F(Scene, APointStandsOnlyWhereItCreepsWithinTheRegion) {
  task.goal.y = 500;
  drive(0.1);
  task.region.y_max = motion.states.back()[Y] + 5;
  EXPECT_NE(judge().certificate.refused.find("creeping out of the region"), std::string::npos)
      << judge().certificate.refused;
  task.region.y_max += 2;
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
}

// What begins nearer to the edge than is needed may have a little less, but not leave the road.
TEST_F(Scene, ABodyThatBeginsAtTheEdgeStaysOnTheRoad) {
  task.vehicle.footprint = FootprintKind::rectangle;
  need.edge = 0.1;
  const double right = task.vehicle.width / 2 + 0.005;
  task.road = std::make_shared<world::Road>(
      std::vector<world::RoadPoint>{{0, -100, right, 4}, {0, 300, right, 4}}, false,
      std::vector<std::vector<world::Point>>{}, "road");
  EXPECT_NEAR(judge().certificate.refused_at, 2, 0.1) << "it does not move away in time";
  for (std::size_t k = 8; k < 12; ++k) motion.states[k][X] = 0.009;  // 4 mm over the edge
  EXPECT_NEAR(judge().certificate.refused_at, 1.4, 0.1);
}

TEST_F(Scene, ABodyStandsOnlyWhereItCreepsWithinTheRegion) {
  task.goal.y = 500;
  task.vehicle.footprint = FootprintKind::rectangle;
  drive(0.1);  // 6 m in the horizon of 60 s
  task.region.y_max = motion.states.back()[Y] + task.vehicle.front_overhang + 4;
  EXPECT_NE(judge().certificate.refused.find("creeping out of the region"), std::string::npos)
      << judge().certificate.refused;
  task.region.y_max += 3;
  EXPECT_TRUE(judge().certificate.verified) << judge().certificate.refused;
}

// A body that begins nearer to something than is needed may leave it, but come no nearer; what a
// point keeps stands for the body that it has not.
TEST_F(Scene, ABodyThatBeginsTooNearMayLeave) {
  need.clearance = 0.3;
  task.vehicle.footprint = FootprintKind::rectangle;
  const double beside = task.vehicle.width / 2 + 0.2 + 1;
  const auto neighbour = [&](double aside) {
    return world::Obstacle{"neighbour", beside - aside, -20, 1, 1, aside, 20};
  };
  EXPECT_TRUE(judge({neighbour(0.2)}).certificate.verified)
      << judge({neighbour(0.2)}).certificate.refused;
  EXPECT_FALSE(judge({neighbour(-0.1)}).certificate.verified) << "it comes nearer";
  EXPECT_FALSE(judge({neighbour(0)}).certificate.verified) << "it stays as near for good";
  task.vehicle.footprint = FootprintKind::point;
  EXPECT_FALSE(judge({{"neighbour", 1.2 - 0.2, -20, 1, 1, 0.2, 20}}).certificate.verified);
}

}  // namespace
}  // namespace slalom::planner
