// The first plan without a drive is that of the drive.

#include <gtest/gtest.h>

#include "sim/fakes.hpp"
#include "slalom/base/error.hpp"

namespace slalom::sim {
namespace {

using testing::open_field;

void expect_same(const Cycle& a, const Cycle& b) {
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.t0, b.t0);
  EXPECT_EQ(a.tex, b.tex);
  EXPECT_EQ(a.t_swap, b.t_swap);
  EXPECT_EQ(a.X0p, b.X0p);
  EXPECT_EQ(a.plan.t_start, b.plan.t_start);
  EXPECT_EQ(a.plan.t, b.plan.t);
  EXPECT_EQ(a.plan.states, b.plan.states);
  EXPECT_EQ(a.plan.controls, b.plan.controls);
  EXPECT_EQ(a.plan.report.status, b.plan.report.status);
  EXPECT_EQ(a.plan.report.iterations, b.plan.report.iterations);
}

TEST(FirstPlan, IsThatOfTheDriveByEveryRule) {
  for (const auto rule : {LatencyRule::instant, LatencyRule::paper, LatencyRule::recorded}) {
    auto s = open_field();
    s.vehicle.tyre_asymmetry = true;
    s.start[vehicle::SA] = 0.02;
    s.loop.timeout = 0.5;
    s.loop.warm_up = true;
    s.loop.latency = rule;
    s.loop.solve_times = {0.9};
    s.sensing.position_noise = 0.2;
    s.sensing.delay = 0.3;
    s.plant.mass_factor = 1.2;
    const auto driven = drive(s, testing::wavy);
    const auto first = first_plan(s, testing::wavy);
    ASSERT_TRUE(first.warm_up && first.cycle);
    expect_same(*first.warm_up, driven.cycles.at(0));
    expect_same(*first.cycle, driven.cycles.at(1));
    EXPECT_FALSE(first.cycle->used);
  }
}

TEST(FirstPlan, OfTheScenariosOwnPlannerHasTheDrivesBits) {
  auto s = open_field();
  s.loop.timeout = 0.5;
  s.loop.warm_up = true;
  s.obstacles = {testing::circle("O1", 1, 60, 4, -1, 0)};
  const auto driven = drive(s);
  const auto first = first_plan(s);
  ASSERT_TRUE(first.warm_up && first.cycle);
  EXPECT_TRUE(first.cycle->plan.report.solved);
  expect_same(*first.warm_up, driven.cycles.at(0));
  expect_same(*first.cycle, driven.cycles.at(1));
}

TEST(FirstPlan, AsksOnceAndOnceMoreToWarmUp) {
  auto s = open_field();
  int asked = 0;
  const auto plan = [&asked](const planner::Request& request) {
    ++asked;
    return testing::straight_on(request);
  };
  EXPECT_FALSE(first_plan(s, plan).warm_up);
  EXPECT_EQ(asked, 1);
  s.loop.warm_up = true;
  EXPECT_TRUE(first_plan(s, plan).warm_up);
  EXPECT_EQ(asked, 3);
}

TEST(FirstPlan, EndsWhereItIsInterrupted) {
  auto s = open_field();
  s.loop.warm_up = true;
  bool pressed = true;
  int presses_at = 0, asked = 0;
  const auto interrupted = [&pressed] { return pressed; };
  const auto plan = [&](const planner::Request& request) {
    pressed = ++asked == presses_at;
    return testing::straight_on(request);
  };
  auto first = first_plan(s, plan, interrupted);
  EXPECT_FALSE(first.warm_up || first.cycle);
  EXPECT_EQ(asked, 0);

  pressed = false;
  presses_at = 1;
  first = first_plan(s, plan, interrupted);
  EXPECT_TRUE(first.warm_up);
  EXPECT_FALSE(first.cycle);

  pressed = false;
  presses_at = 3;
  first = first_plan(s, plan, interrupted);
  EXPECT_TRUE(first.cycle) << "what was planned until then is there";
}

TEST(FirstPlan, MissesADeadlineHeldAgainstAScriptedCharge) {
  auto s = open_field();
  s.loop.latency = LatencyRule::recorded;
  s.loop.solve_times = {0.6};
  s.loop.deadline = Deadline::tex;
  const auto first = first_plan(s, testing::straight_on);
  EXPECT_EQ(first.cycle->plan.report.status, planner::PlanStatus::time_limit);
}

TEST(FirstPlan, RefusesWhatCheckRefuses) {
  auto s = open_field();
  s.loop.tex = -1;
  EXPECT_THROW((void)first_plan(s, testing::straight_on), InvalidValue);
  EXPECT_THROW((void)first_plan(s), InvalidValue);
}

}  // namespace
}  // namespace slalom::sim
