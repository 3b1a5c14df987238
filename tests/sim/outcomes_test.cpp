// Every way a drive can end.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "sim/fakes.hpp"

namespace slalom::sim {
namespace {

using testing::open_field;
using testing::plan_of;
using testing::Requests;
using testing::straight_on;
using vehicle::Control;

TEST(Outcomes, TimeoutEndsTheDrive) {
  auto s = open_field();
  s.loop.timeout = 1.2;
  const Drive d = drive(s, straight_on);
  EXPECT_EQ(d.outcome, Outcome::timeout);
  EXPECT_EQ(d.time, 1.2);
  EXPECT_FALSE(d.goal_time);
}

TEST(Outcomes, GoalAtTheLastCheckBeatsTheTimeout) {
  auto s = open_field();
  s.loop.timeout = 2;
  s.goal = {0, 34, 1.5, 1};
  EXPECT_EQ(drive(s, straight_on).outcome, Outcome::goal);
  s.loop.timeout = 1.95;  // within the square, but not at the end of an execution horizon
  EXPECT_EQ(drive(s, straight_on).outcome, Outcome::timeout);
}

TEST(Outcomes, UnsolvedStopsWhenThePlanIsDue) {
  auto s = open_field();
  int calls = 0;
  const Drive d =
      drive(s, [&](const auto& r) { return ++calls < 4 ? straight_on(r) : testing::unsolved(r); });
  EXPECT_EQ(d.outcome, Outcome::not_optimal);
  EXPECT_EQ(d.time, 2);
  EXPECT_EQ(d.plant.back().t, 2);
  ASSERT_EQ(d.cycles.size(), 4u);
  EXPECT_FALSE(d.cycles.back().used);
  EXPECT_NE(d.message.find("cycle 4"), std::string::npos);
  EXPECT_NE(d.message.find("iteration_limit"), std::string::npos);
}

TEST(Outcomes, CrashBeforeThePlanIsDueBeatsTheFailureToPlan) {
  auto s = open_field();
  s.obstacles = {testing::circle("rock", 0, 25, 1)};  // touched at 22/17 s
  int calls = 0;
  const auto fails_at = [&](int call) {
    calls = 0;
    return drive(s, [&calls, call](const auto& r) {
      return ++calls < call ? straight_on(r) : testing::unsolved(r);
    });
  };
  const Drive crashed = fails_at(3);  // planned from 1 s, due at 1.5 s
  EXPECT_EQ(crashed.outcome, Outcome::crash) << crashed.message;
  EXPECT_NEAR(crashed.time, 22. / 17, 1e-6);
  EXPECT_EQ(crashed.cycles.size(), 3u);
  const Drive stopped = fails_at(2);  // due at 1 s
  EXPECT_EQ(stopped.outcome, Outcome::not_optimal) << stopped.message;
  EXPECT_EQ(stopped.time, 1);
}

TEST(Outcomes, FailureToPlanBeatsTheGoal) {
  auto s = open_field();
  s.goal = {0, 34, 1.5, 1};
  int calls = 0;
  const Drive d =
      drive(s, [&](const auto& r) { return ++calls < 4 ? straight_on(r) : testing::unsolved(r); });
  EXPECT_EQ(d.time, 2);
  EXPECT_EQ(d.outcome, Outcome::not_optimal);
}

TEST(Outcomes, SolvedPlanWithoutUsableControlsCountsAsUnsolved) {
  const Drive d = drive(open_field(), [](const auto& r) {
    auto plan = straight_on(r);
    plan.controls[2][0] = std::nan("");
    return plan;
  });
  EXPECT_EQ(d.outcome, Outcome::not_optimal);
  EXPECT_NE(d.message.find("no usable controls"), std::string::npos);
}

TEST(Outcomes, SolveTimeOverTheLimitEndsTheDriveEvenIfSolved) {
  auto s = open_field();
  s.loop.on_failure = OnFailure::last_plan;  // the limit is a failure of its own
  int calls = 0;
  const Drive d = drive(s, [&](const auto& r) {
    auto plan = straight_on(r);
    plan.report.wall_s = ++calls < 3 ? 299 : 301;
    return plan;
  });
  EXPECT_EQ(d.outcome, Outcome::solve_time);
  EXPECT_EQ(d.time, 1.5);
}

TEST(Outcomes, SolveCutOffByItsTimeLimitIsSolveTime) {
  auto s = open_field();
  s.loop.solve_time_limit = .05;
  const Drive d = drive(s, [](const planner::Request& r) {
    std::this_thread::sleep_for(std::chrono::duration<double>(r.time_limit));
    return testing::unsolved(r);
  });
  EXPECT_EQ(d.outcome, Outcome::solve_time);
  EXPECT_EQ(d.time, .5);
}

TEST(Outcomes, InterruptedBetweenCyclesWhilePlanningAndWhileDriving) {
  const auto s = open_field();
  // At once: nothing is planned.
  Requests requests;
  LoopHooks hooks;
  hooks.interrupted = [] { return true; };
  Drive d = drive(s, requests.answering(straight_on), hooks);
  EXPECT_EQ(d.outcome, Outcome::interrupted);
  EXPECT_EQ(d.time, 0);
  EXPECT_TRUE(requests.all.empty());
  EXPECT_EQ(d.plant.size(), 1u);

  // While planning: the solver is handed the hook; its unsolved answer does not hide the reason.
  bool pressed = false;
  hooks.interrupted = [&] { return pressed; };
  d = drive(
      s,
      [&](const planner::Request& r) {
        if (r.t0 < 1) return straight_on(r);
        pressed = true;
        EXPECT_TRUE(r.interrupted && r.interrupted());
        return testing::unsolved(r);
      },
      hooks);
  EXPECT_EQ(d.outcome, Outcome::interrupted);
  EXPECT_EQ(d.time, 1);

  // While driving: within the horizon, at a sample.
  int polls_after_plan = 0;
  hooks.interrupted = [&] { return !requests.all.empty() && ++polls_after_plan > 10; };
  d = drive(s, requests.answering(straight_on), hooks);
  EXPECT_EQ(d.outcome, Outcome::interrupted);
  EXPECT_GT(d.time, .1);
  EXPECT_LT(d.time, .3);
  EXPECT_EQ(d.plant.back().t, d.time);
}

TEST(Outcomes, LostPlantIsAnOutcomeNotAnException) {
  auto s = open_field();
  s.loop.on_failure = OnFailure::last_plan;
  s.loop.timeout = 60;
  int calls = 0;
  const Drive d = drive(s, [&](const planner::Request& r) {
    if (++calls > 1) return testing::unsolved(r);
    return plan_of(r, [](double) { return Control{.5, 1e200}; });
  });
  EXPECT_EQ(d.outcome, Outcome::not_optimal) << d.message;
  EXPECT_NE(d.message.find("no usable plan was left"), std::string::npos) << d.message;
  const auto& report = d.cycles.back().plan.report;
  EXPECT_EQ(report.status, planner::PlanStatus::no_prediction);
  EXPECT_EQ(report.status_text().rfind("no prediction: the plant cannot be integrated", 0), 0u);
}

TEST(Outcomes, AMeasurementThatNoPlannerTakesIsACycleWithoutPrediction) {
  auto s = open_field();
  s.region = {};
  s.start[vehicle::X] = 9.99e8;
  s.sensing.position_noise = 1e6;  // and a planner takes up to 1e9 m
  s.loop.on_failure = OnFailure::last_plan;
  s.loop.timeout = 5;
  const Drive d = drive(s, [](const planner::Request& r) {
    planner::check(r, "plan");
    return straight_on(r);
  });
  EXPECT_EQ(d.outcome, Outcome::timeout) << d.message;
  int lost = 0;
  for (const auto& cycle : d.cycles) {
    if (cycle.plan.report.solved) continue;
    ++lost;
    EXPECT_EQ(
        cycle.plan.report.status_text().rfind("no prediction: request: state: found x = 1", 0), 0U)
        << cycle.plan.report.status_text();
    EXPECT_FALSE(cycle.used);
  }
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, static_cast<int>(d.cycles.size()));
}

TEST(Outcomes, HaveTheNamesFilesUse) {
  EXPECT_STREQ(to_string(Outcome::goal), "goal");
  EXPECT_STREQ(to_string(Outcome::wheel_lift), "wheel_lift");
  EXPECT_STREQ(to_string(Outcome::not_optimal), "not_optimal");
  EXPECT_STREQ(to_string(Outcome::interrupted), "interrupted");
  EXPECT_EQ(outcome_names().size(), 8u);
}

}  // namespace
}  // namespace slalom::sim
