// When plans take effect, by each rule.

#include "slalom/sim/latency.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "sim/fakes.hpp"
#include "slalom/base/error.hpp"
#include "slalom/sim/solve_times.hpp"

namespace slalom::sim {
namespace {

using testing::open_field;
using vehicle::Control;

/// A scenario whose cycles cost these times [s].
Scenario charged(const std::vector<double>& times) {
  auto s = open_field();
  s.loop.latency = LatencyRule::recorded;
  s.loop.solve_times = times;
  s.loop.timeout = 4;
  return s;
}

/// Each plan accelerates by a jerk of its own: 1, 2, 3, ... hundredths.
PlanFunction numbered(std::vector<planner::Request>& asked) {
  return [&asked](const planner::Request& request) {
    asked.push_back(request);
    const double jerk = 0.01 * static_cast<double>(asked.size());
    return testing::plan_of(request, [jerk](double) { return Control{0, jerk}; });
  };
}

/// Jerk that the plant drove just after t.
double jerk_after(const Drive& d, double t) {
  for (const auto& sample : d.plant)
    if (sample.t > t + 1e-6) return sample.control[vehicle::JX];
  return std::nan("");
}

TEST(Latency, ALatePlanTakesEffectWhenItIsReadyAndTheOldOneRunsOn) {
  std::vector<planner::Request> asked;
  const auto d = drive(charged({0.2, 0.8, 0.5}), numbered(asked));
  ASSERT_GE(d.cycles.size(), 4U);
  const double swaps[] = {0.5, 1.3, 1.8, 2.3}, begins[] = {0, 0.5, 1.3, 1.8};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(d.cycles[k].t0, begins[k], 1e-12) << k;
    EXPECT_NEAR(d.cycles[k].t_swap, swaps[k], 1e-12) << k;
    EXPECT_EQ(asked[k].t0, d.cycles[k].t0);
    EXPECT_EQ(asked[k].t_start, asked[k].t0 + 0.5);
    // Until the swap the plan before drives, after it this one.
    EXPECT_NEAR(jerk_after(d, swaps[k] - 0.1), 0.01 * static_cast<double>(k), 1e-9) << k;
    EXPECT_NEAR(jerk_after(d, swaps[k]), 0.01 * static_cast<double>(k + 1), 1e-9) << k;
  }
  EXPECT_EQ(d.cycles[1].charged, 0.8);
}

TEST(Latency, ALatePlanOfAPlannerThatVerifiesIsNotDrivenAndTheLastGoesOn) {
  auto s = open_field();
  s.planner.method = planner::Method::verified;
  s.loop.latency = LatencyRule::recorded;
  s.loop.deadline = Deadline::tex;
  s.loop.solve_times = {0.1, 0.7, 0.1};
  s.loop.timeout = 3;
  const auto d = drive(s, testing::wavy);
  EXPECT_EQ(d.outcome, Outcome::timeout) << d.message;
  ASSERT_GE(d.cycles.size(), 3u);
  EXPECT_TRUE(d.cycles[0].used);
  EXPECT_TRUE(d.cycles[1].late);
  EXPECT_FALSE(d.cycles[1].used);
  EXPECT_TRUE(d.cycles[2].used);
}

TEST(Latency, ScriptedTimesWithinTheHorizonGiveThePapersDrive) {
  auto paper = open_field();
  paper.loop.timeout = 4;
  const auto expected = drive(paper, testing::wavy);
  auto model = paper;
  model.loop.latency = LatencyRule::model;
  model.loop.latency_median = 0.1;
  model.loop.latency_spread = 0.2;
  for (const auto& s : {charged({0.1, 0.5, 0}), model}) {
    const auto d = drive(s, testing::wavy);
    ASSERT_EQ(d.plant.size(), expected.plant.size());
    for (std::size_t i = 0; i < d.plant.size(); ++i) {
      EXPECT_EQ(d.plant[i].t, expected.plant[i].t);
      EXPECT_EQ(d.plant[i].state, expected.plant[i].state);
    }
  }
}

TEST(Latency, ScriptedDrivesDoNotDependOnHowLongPlanningTakes) {
  const auto slow = [](const planner::Request& request) {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    return testing::wavy(request);
  };
  auto s = charged({0.02, 0.09, 0.05, 0.13});
  s.loop.tex = 0.05;
  s.loop.timeout = 0.5;
  const auto one = drive(s, testing::wavy), two = drive(s, slow);
  ASSERT_EQ(one.plant.size(), two.plant.size());
  for (std::size_t i = 0; i < one.plant.size(); ++i)
    EXPECT_EQ(one.plant[i].state, two.plant[i].state);
  // By the clock the same planner is late.
  s.loop.latency = LatencyRule::measured;
  const auto measured = drive(s, slow);
  EXPECT_GE(measured.cycles[0].charged, 0.06);
  EXPECT_GE(measured.cycles[1].t0, 0.06);
}

TEST(Latency, InstantPlansStartWhereThePlantStands) {
  auto s = open_field();
  s.loop.latency = LatencyRule::instant;
  s.loop.timeout = 2;
  std::vector<planner::Request> asked;
  const auto d = drive(s, numbered(asked));
  ASSERT_EQ(d.cycles.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(asked[k].t_start, asked[k].t0);
    EXPECT_EQ(asked[k].t0, 0.5 * static_cast<double>(k));
    EXPECT_EQ(d.cycles[k].t_swap, d.cycles[k].t0);
    EXPECT_TRUE(d.cycles[k].used);
    EXPECT_NEAR(jerk_after(d, d.cycles[k].t0), 0.01 * static_cast<double>(k + 1), 1e-9);
    const auto at = std::find_if(d.plant.begin(), d.plant.end(),
                                 [&](const auto& p) { return p.t == d.cycles[k].t0; });
    ASSERT_NE(at, d.plant.end());
    EXPECT_EQ(asked[k].X0p, at->state);
  }
  const auto failing = drive(s, testing::unsolved);
  EXPECT_EQ(failing.outcome, Outcome::not_optimal);
  EXPECT_EQ(failing.time, 0);
}

TEST(Latency, ADeadlineIsHeldAgainstTheTimeCharged) {
  auto s = charged({0.1, 0.6});
  s.loop.deadline = Deadline::tex;
  std::vector<planner::Request> asked;
  const auto stopped = drive(s, numbered(asked));
  EXPECT_EQ(stopped.outcome, Outcome::not_optimal);
  EXPECT_EQ(stopped.time, 1);
  EXPECT_NE(stopped.message.find("time_limit"), std::string::npos);
  EXPECT_EQ(asked[0].time_limit, s.loop.solve_time_limit);  // no clock decides
  s.loop.on_failure = OnFailure::last_plan;
  const auto driven = drive(s, testing::straight_on);
  ASSERT_EQ(driven.cycles.size(), 8U);
  for (const auto& cycle : driven.cycles) {
    EXPECT_EQ(cycle.t_swap, cycle.t0 + 0.5);
    EXPECT_EQ(cycle.plan.report.solved, cycle.index % 2 == 1);
  }
}

TEST(Latency, AChargedTimeBeyondTheLimitEndsTheDrive) {
  auto s = charged({0.1, 2.5});
  s.loop.solve_time_limit = 2;
  EXPECT_EQ(drive(s, testing::straight_on).outcome, Outcome::solve_time);
}

TEST(Latency, TheModelIsLognormalAndSeeded) {
  LoopSettings settings;
  settings.latency = LatencyRule::model;
  settings.latency_median = 0.3;
  settings.latency_spread = 0.7;
  std::vector<double> logs;
  for (int k = 1; k <= 4000; ++k) logs.push_back(std::log(Latency(settings).charge(k, 9) / 0.3));
  double mean = 0, square = 0;
  for (const double x : logs) {
    mean += x / 4000;
    square += x * x / 4000;
  }
  EXPECT_NEAR(mean, 0, 5 * 0.7 / std::sqrt(4000.0));  // five standard errors
  EXPECT_NEAR(square, 0.49, 5 * 0.49 * std::sqrt(2.0 / 4000));
  auto other = settings;
  other.latency_seed = 1;
  EXPECT_NE(Latency(settings).charge(1, 0), Latency(other).charge(1, 0));
  other.latency_spread = 0;
  EXPECT_EQ(Latency(other).charge(5, 0), 0.3);
}

TEST(Latency, RecordedWithoutTimesIsRefused) {
  EXPECT_THROW((void)drive(charged({}), testing::straight_on), InvalidValue);
}

}  // namespace
}  // namespace slalom::sim
