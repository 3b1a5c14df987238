// The ladder of a planner that verifies: new plan, rest of the last, least bad motion.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/verified_scenes.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

double clearance(const Task& task, const Request& request, const Plan& plan) {
  const Plant plant(task.vehicle, 1e-9, 0.02);
  const auto signal = control_signal(plan);
  State x = request.X0p;
  double least = INFINITY;
  for (double t = plan.t_start; t < plan.t_start + plan.tf; t += 0.01) {
    for (const auto& o : task.obstacles) least = std::min(least, distance(o, x[X], x[Y], t));
    x = plant.predict(x, signal, t, t + 0.01);
  }
  return least;
}

void expect_same_controls(const Plan& one, const Plan& other) {
  for (const double at : {1.2, 3.3})
    for (std::size_t c = 0; c < kControls; ++c)
      EXPECT_NEAR(control_signal(one).at(at)[c], control_signal(other).at(at)[c], 1e-12);
}

TEST(VerifiedPlanner, ItsFirstPlanIsVerifiedAndWhatTheCertificateSays) {
  const Task t = verified_task();
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  EXPECT_EQ(plan.rung, Rung::new_plan);
  EXPECT_TRUE(plan.report.solved);
  EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
  EXPECT_TRUE(plan.goal_in_range);
  EXPECT_GE(plan.certificate.least_clearance, t.planner.verified_clearance);
  EXPECT_NEAR(clearance(t, northwards(), plan), plan.certificate.least_clearance, 0.02);
  EXPECT_EQ(plan.certificate.nearest, "O1");
  const auto driven = std::find_if(plan.candidates.begin(), plan.candidates.end(),
                                   [&](const auto& c) { return c.cost == plan.report.cost; });
  ASSERT_NE(driven, plan.candidates.end());
  EXPECT_EQ(driven->path.front().y, plan.states.front()[Y]);
  EXPECT_EQ(driven->path.back().y, plan.states.back()[Y]);
  EXPECT_GT(driven->path.size(), 20u);
  EXPECT_LE(driven->path.size(), 61u);
}

TEST(VerifiedPlanner, TheRestOfAPlanIsDrivenOnWhileItIsGood) {
  const Task t = verified_task();
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  Request request = next(t, northwards(), plan);
  request.time_limit = 0;  // there is no time for anything else
  const Plan rest = planner.plan(request);
  EXPECT_EQ(rest.rung, Rung::rest);
  EXPECT_TRUE(rest.certificate.verified);
  EXPECT_NEAR(rest.t_start + rest.tf, plan.t_start + plan.tf, 1e-9);
  expect_same_controls(rest, plan);
}

TEST(VerifiedPlanner, WhereThePlanWasLateTheOneBeforeGoesOn) {
  const Task t = verified_task();
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  Request elsewhere = next(t, northwards(), plan);
  elsewhere.X0p[X] += 0.3;
  elsewhere.time_limit = 0;
  (void)planner.plan(elsewhere);  // is late, and not driven
  Request request = next(t, northwards(), plan);
  request.time_limit = 0;
  request.last_was_late = true;
  const Plan rest = planner.plan(request);
  EXPECT_EQ(rest.rung, Rung::rest);
  expect_same_controls(rest, plan);
}

TEST(VerifiedPlanner, ARestFromAnotherStateIsDrivenAnewByThePlant) {
  const Task t = verified_task();
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  Request request = next(t, northwards(), plan);
  request.X0p[X] += 0.3;
  request.time_limit = 0;
  const Plan rest = planner.plan(request);
  ASSERT_GT(rest.states.size(), 20U);
  EXPECT_EQ(rest.states[0], request.X0p);
  const State there =
      Plant(t.vehicle, 1e-9, 0.02)
          .predict(request.X0p, control_signal(rest), rest.t_start, rest.t_start + rest.t[20]);
  for (std::size_t i = 0; i < kStates; ++i) EXPECT_NEAR(rest.states[20][i], there[i], 1e-6);
}

TEST(VerifiedPlanner, WhatComesIntoTheWayIsAvoided) {
  const Task t = verified_task();
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  Request request = next(t, northwards(), plan);
  // Where the plan would be in 4 s.
  const State there = plan.states[std::min<std::size_t>(plan.states.size() - 1, 90)];
  request.obstacles = t.obstacles;
  request.obstacles->push_back({"new", there[X], there[Y], 3, 3, 0, 0});
  const Plan other = planner.plan(request);
  EXPECT_EQ(other.rung, Rung::new_plan);
  EXPECT_TRUE(other.certificate.verified);
  EXPECT_TRUE(std::any_of(other.candidates.begin(), other.candidates.end(), [](const auto& c) {
    return c.name == "rest" && c.certificate.refused.find("new") != std::string::npos;
  }));
}

// What is seen at last where another was is no error of belief.
TEST(VerifiedPlanner, ObstaclesAreTheSameByName) {
  Task t = verified_task();
  t.obstacles.push_back({"far", 200, 80, 3, 3, 0, 0});
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  Request request = next(t, northwards(), plan);
  const State there = plan.states[std::min<std::size_t>(plan.states.size() - 1, 90)];
  request.obstacles = {{"new", there[X], there[Y], 3, 3, 0, 0}, t.obstacles[0]};
  const Plan other = planner.plan(request);
  EXPECT_EQ(other.rung, Rung::new_plan);
  EXPECT_TRUE(other.certificate.verified) << other.certificate.refused;
}

// By the latency rule `instant` a plan begins when it is made, and the loop looks a horizon apart.
TEST(VerifiedPlanner, AnArrivalIsWhereTheLoopLooks) {
  Task t = verified_task();
  t.goal.sigma = 2;
  const Plant plant(t.vehicle, 1e-9, 0.02);
  for (const double begin : {0., 3., 6.}) {
    Request request = northwards();
    request.X0p[Y] = begin;
    request.t_start = request.t0 = 0.5;
    request.tex = 0.5;
    const Plan plan = Planner(t).plan(request);
    ASSERT_TRUE(plan.certificate.verified) << plan.certificate.refused;
    ASSERT_TRUE(plan.goal_in_range) << "from " << begin;
    bool arrives = false;
    State x = request.X0p;
    for (double at = 0.5; at < plan.t_start + plan.tf && !arrives; at += 0.5) {
      arrives = t.goal.outside(x, at, nullptr) <= 0;
      x = plant.predict(x, control_signal(plan), at, at + 0.5);
    }
    EXPECT_TRUE(arrives) << "from " << begin;
  }
}

TEST(VerifiedPlanner, ThereIsAPlanWhereNoneIsGoodAndItSaysSo) {
  Task t = verified_task();
  t.obstacles = {{"wall", 0, 14, 60, 2, 0, 0}};  // 12 m ahead at 17 m/s
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  EXPECT_EQ(plan.rung, Rung::least_bad);
  EXPECT_FALSE(plan.report.solved);
  EXPECT_TRUE(plan.report.best_iterate) << "it is driven all the same";
  EXPECT_EQ(plan.report.status, PlanStatus::unverified);
  EXPECT_NE(plan.report.status_text().find("wall"), std::string::npos);
  EXPECT_TRUE(usable(plan));
}

TEST(VerifiedPlanner, WithoutAWayToTheGoalItStopsClear) {
  const Task t = before_a_wall(110);
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
  EXPECT_FALSE(plan.goal_in_range);
  EXPECT_LT(plan.states.back()[UX], 0.5);
  EXPECT_NEAR(plan.states.back()[AX], 0, 1e-3);
  EXPECT_EQ(plan.controls.back(), (Control{0, 0}));
}

TEST(VerifiedPlanner, AStopIsSearchedForWhereNeitherStraightOnNorASwerveEndsWell) {
  // Something comes along the lane that is wider than a swerve, and a wall ends the road behind it.
  Task t = before_a_wall(100);
  t.planner.search_places = 50'000;
  t.region.x_min = -6;
  t.region.x_max = 9;
  t.obstacles.push_back({"oncoming", -1, 89, 3.3, 6, 0, -4});
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
  EXPECT_FALSE(plan.goal_in_range);
  EXPECT_TRUE(std::any_of(plan.candidates.begin(), plan.candidates.end(),
                          [](const auto& c) { return c.name == "stop in time"; }));
}

TEST(VerifiedPlanner, ByRangeItKnowsWhatIsNear) {
  Task t = verified_task();
  t.planner.known = Known::range;
  t.planner.L_range = 50;
  Planner planner(t);
  const Plan plan = planner.plan(northwards());
  EXPECT_TRUE(std::isinf(plan.certificate.least_clearance)) << "nothing is within 50 m";
  Request nearer = northwards();
  nearer.X0p[Y] = 40;
  planner.reset();
  EXPECT_EQ(planner.plan(nearer).certificate.nearest, "O1");
}

TEST(VerifiedPlanner, WhereAnythingMayStandUnseenItStopsWithinWhatIsSeen) {
  Task t = verified_task();
  t.planner.known = Known::range;
  t.planner.L_range = 90;
  const double edge = t.planner.L_range - t.planner.verified_clearance;
  Planner planner(t);
  Request request = northwards();
  Plan plan = planner.plan(request);
  for (int cycle = 0; cycle < 4; ++cycle) {
    EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
    const double from = request.X0p[Y] - request.X0p[UX] * (request.t_start - request.t0);
    EXPECT_LE(plan.states.back()[Y] - from, edge);
    EXPECT_LT(plan.states.back()[UX], 0.5);
    request = next(t, request, plan);
    const Plan later = planner.plan(request);
    EXPECT_GT(later.states.back()[Y], plan.states.back()[Y]) << "it sees further by now";
    plan = later;
  }
  planner.reset();
  const auto candidates = planner.plan(northwards()).candidates;
  EXPECT_TRUE(std::none_of(candidates.begin(), candidates.end(), [](const auto& c) {
    return c.name.find("course") != std::string::npos || c.name.find("rest") != std::string::npos;
  })) << "of a planner that has forgotten its last plan";
  t.planner.unseen = Unseen::nothing;
  EXPECT_TRUE(Planner(t).plan(northwards()).goal_in_range);
}

TEST(VerifiedPlanner, AVehicleAtRestAlwaysHasAPlanThatLasts) {
  const Task t = before_a_wall(20);
  Planner planner(t);
  Request request = northwards();
  request.X0p[UX] = 0.12;
  for (int cycle = 0; cycle < 8; ++cycle) {
    const Plan plan = planner.plan(request);
    ASSERT_TRUE(usable(plan));
    EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
    EXPECT_GE(plan.tf, 0.5 - 1e-6);
    request = next(t, request, plan);
    request.X0p[UX] -= 0.01;  // as a sensor may have it
  }
}

// The acceleration that it begins with is taken away before it creeps.
TEST(VerifiedPlanner, AVehicleThatAllButStandsGoesOnStanding) {
  const Task t = before_a_wall(10.9);  // room to creep for 6.7 m at .1 m/s for a minute
  Planner planner(t);
  Request request = northwards();
  request.X0p[UX] = 0.1;
  request.X0p[AX] = 0.015;
  for (int cycle = 0; cycle < 4; ++cycle) {
    const Plan plan = planner.plan(request);
    EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
    request = next(t, request, plan);
  }
}

TEST(VerifiedPlanner, CallsOutOfOrderHavePlansThatCanBeDriven) {
  const Task t = verified_task();
  Planner planner(t);
  double last = 0;
  // Twice at a moment, back, far ahead, and back from there.
  for (const double t0 : {0., 0., -0.2, -5., 100., 100.5, 100.5, 0.}) {
    Request request = northwards();
    request.t0 = t0;
    request.t_start = t0 + 0.5;
    const Plan plan = planner.plan(request);
    SCOPED_TRACE(std::to_string(t0) + " after " + std::to_string(last));
    ASSERT_TRUE(usable(plan));
    EXPECT_EQ(plan.t.front(), 0) << "it begins when it is asked for";
    EXPECT_EQ(plan.states.front(), request.X0p);
    EXPECT_TRUE(plan.certificate.verified) << plan.certificate.refused;
    last = t0;
  }
}

TEST(VerifiedPlanner, TheSameRequestsGiveTheSameBits) {
  const Task t = verified_task();
  std::vector<State> ends;
  for (int run = 0; run < 2; ++run) {
    Planner planner(t);
    Request request = northwards();
    Plan plan = planner.plan(request);
    for (int cycle = 0; cycle < 3; ++cycle) {
      request = next(t, request, plan);
      plan = planner.plan(request);
    }
    ends.push_back(plan.states.back());
  }
  EXPECT_EQ(ends[0], ends[1]);
}

}  // namespace
}  // namespace slalom::planner
