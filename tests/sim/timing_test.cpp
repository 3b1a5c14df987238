// The clock of the loop: what each rule of latency and deadline decides.

#include "../../src/sim/timing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace slalom::sim {
namespace {

using planner::PlanStatus;

LoopSettings by(LatencyRule rule, std::vector<double> solve_times = {0.1}) {
  LoopSettings settings;
  settings.latency = rule;
  settings.solve_times = std::move(solve_times);
  return settings;
}

/// The next cycle of `timing`, solved after `measured` seconds by the wall clock, and settled.
Cycle settled(Timing& timing, int index, double measured) {
  Cycle cycle;
  cycle.index = index;
  cycle.t0 = timing.next_cycle();
  cycle.solve_time = measured;
  cycle.plan.report.solved = true;
  cycle.plan.report.status = PlanStatus::solved;
  timing.settle(cycle);
  return cycle;
}

TEST(Timing, ThePlantWaitsByTheRuleInstantAlone) {
  for (const auto rule : {LatencyRule::instant, LatencyRule::paper, LatencyRule::measured,
                          LatencyRule::recorded, LatencyRule::model}) {
    const auto settings = by(rule);
    const Timing timing(settings);
    const bool instant = rule == LatencyRule::instant;
    EXPECT_EQ(timing.plant_waits(), instant);
    EXPECT_EQ(timing.plan_start(3), instant ? 3 : 3.5);
    EXPECT_EQ(timing.next_cycle(), 0);
  }
}

TEST(Timing, TheDeadlineLimitsPlanningUnlessTheChargeIsScripted) {
  for (const auto& [rule, limit] :
       {std::pair{LatencyRule::instant, 0.5}, std::pair{LatencyRule::paper, 0.5},
        std::pair{LatencyRule::measured, 0.5}, std::pair{LatencyRule::recorded, 7.},
        std::pair{LatencyRule::model, 7.}}) {
    auto settings = by(rule);
    settings.solve_time_limit = 7;
    EXPECT_EQ(Timing(settings).time_limit(), 7);
    EXPECT_EQ(Timing(settings, planner::Method::verified).time_limit(), limit)
        << "a planner that verifies has it by itself";
    settings.deadline = Deadline::off;
    EXPECT_EQ(Timing(settings, planner::Method::verified).time_limit(), 7);
    settings.deadline = Deadline::tex;
    EXPECT_EQ(Timing(settings).time_limit(), limit);
  }
}

TEST(Timing, CyclesKeepToTheGridHoweverLongPlanningTakesByThePaper) {
  const auto settings = by(LatencyRule::paper);
  Timing timing(settings);
  for (int k = 1; k <= 7; ++k) {
    const auto cycle = settled(timing, k, 2);
    EXPECT_EQ(cycle.t0, (k - 1) * 0.5);
    EXPECT_EQ(cycle.charged, 0);
    EXPECT_EQ(cycle.solve_time, 2);
    EXPECT_EQ(cycle.t_swap, k * 0.5);
    EXPECT_EQ(timing.next_cycle(), k * 0.5);
  }
}

TEST(Timing, AnInstantPlanTakesEffectAsItsCycleBegins) {
  const auto settings = by(LatencyRule::instant);
  Timing timing(settings);
  for (int k = 1; k <= 3; ++k) {
    const auto cycle = settled(timing, k, 2);
    EXPECT_EQ(cycle.t_swap, (k - 1) * 0.5);
    EXPECT_EQ(timing.next_cycle(), k * 0.5);
  }
}

TEST(Timing, ALatePlanBeginsAnotherGrid) {
  const auto settings = by(LatencyRule::measured);
  Timing timing(settings);
  const double measured[] = {0.2, 0.8, 0.5, 0}, swaps[] = {0.5, 0.5 + 0.8, 0.5 + 0.8 + 0.5};
  for (int k = 0; k < 3; ++k) {
    const auto cycle = settled(timing, k + 1, measured[k]);
    EXPECT_EQ(cycle.charged, measured[k]);
    EXPECT_EQ(cycle.t_swap, swaps[k]) << k;
    EXPECT_EQ(timing.next_cycle(), swaps[k]) << k;
  }
}

TEST(Timing, ALatePlanOfAPlannerThatVerifiesIsNotTheOneThatWasVerified) {
  for (const auto rule : {LatencyRule::measured, LatencyRule::recorded}) {
    auto settings = by(rule, {0.1, 0.75});
    settings.deadline = Deadline::tex;
    Timing timing(settings, planner::Method::verified), of_others(settings);
    EXPECT_FALSE(settled(timing, 1, 0.1).late);
    EXPECT_TRUE(settled(timing, 2, 0.75).late);
    EXPECT_FALSE(settled(of_others, 1, 0.1).late);
    EXPECT_FALSE(settled(of_others, 2, 0.75).late);
  }
}

TEST(Timing, WhereTheClockIsChargedItLimitsAPlannerThatVerifies) {
  const auto measured = by(LatencyRule::measured), paper = by(LatencyRule::paper);
  EXPECT_EQ(Timing(measured, planner::Method::verified).clock_limit(), 0.5);
  EXPECT_EQ(Timing(paper, planner::Method::verified).clock_limit(), HUGE_VAL);
  EXPECT_EQ(Timing(measured).clock_limit(), HUGE_VAL) << "it has no deadline";
}

TEST(Timing, AScriptedChargeIsTheSolveTimeAndTheDeadlineIsHeldAgainstIt) {
  auto settings = by(LatencyRule::recorded, {0.1, 0.75});
  for (const auto deadline : {Deadline::off, Deadline::tex}) {
    settings.deadline = deadline;
    Timing timing(settings);
    EXPECT_EQ(settled(timing, 1, 9).solve_time, 0.1);
    const auto late = settled(timing, 2, 9);
    const bool cut_off = deadline == Deadline::tex;
    EXPECT_EQ(late.charged, cut_off ? 0.5 : 0.75);
    EXPECT_EQ(late.solve_time, late.charged);
    EXPECT_EQ(late.t_swap, 0.5 + late.charged);
    EXPECT_EQ(late.plan.report.solved, !cut_off);
    EXPECT_EQ(late.plan.report.status, cut_off ? PlanStatus::time_limit : PlanStatus::solved);
  }
}

}  // namespace
}  // namespace slalom::sim
