// How the loop takes turns.

#include "slalom/sim/closed_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/fakes.hpp"
#include "slalom/sim/solve_times.hpp"
#include "vehicle/reintegrate.hpp"

namespace slalom::sim {
namespace {

using testing::open_field;
using testing::plan_of;
using testing::Requests;
using testing::straight_on;
using vehicle::Control;

TEST(ClosedLoop, OneRequestACycleWithThePredictedState) {
  auto s = open_field();
  s.loop.timeout = 2;
  s.loop.solve_time_limit = 7;
  Requests requests;
  const Drive d = drive(s, requests.answering(testing::wavy));
  ASSERT_EQ(requests.all.size(), 4u);
  ASSERT_EQ(d.cycles.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(requests.all[i].t0, .5 * static_cast<double>(i));
    EXPECT_EQ(requests.all[i].t_start, requests.all[i].t0 + .5);
    EXPECT_EQ(requests.all[i].time_limit, 7);
    EXPECT_EQ(d.cycles[i].index, static_cast<int>(i) + 1);
    EXPECT_EQ(d.cycles[i].t0, requests.all[i].t0);
    EXPECT_EQ(d.cycles[i].X0p, requests.all[i].X0p);
    EXPECT_EQ(d.cycles[i].used, i < 3);  // the drive ended before the fourth took over
  }
}

Scenario weaving_field() {
  auto s = open_field();
  s.vehicle.tyre_asymmetry = true;
  s.loop.timeout = 6;
  s.loop.tex = .4;
  return s;
}

/// A drive there that weaves, made once for all tests that only look at it.
const Drive& weaving() {
  static const Drive drive = sim::drive(weaving_field(), testing::wavy);
  return drive;
}

TEST(ClosedLoop, PredictionIsWhereThePlantArrives) {
  const Drive& d = weaving();
  int compared = 0;
  for (const auto& cycle : d.cycles)
    for (const auto& sample : d.plant)
      if (std::abs(sample.t - (cycle.t0 + cycle.tex)) < 1e-12) {
        ++compared;
        for (std::size_t i = 0; i < vehicle::kStates; ++i)
          EXPECT_NEAR(sample.state[i], cycle.X0p[i], 1e-8) << vehicle::kStateNames[i];
      }
  EXPECT_GE(compared, 12);
}

TEST(ClosedLoop, WarmUpIsOneMoreCallWithTheFirstRequest) {
  auto s = open_field();
  s.loop.timeout = 1;
  s.loop.warm_up = true;
  Requests requests;
  const Drive d = drive(s, requests.answering(straight_on));
  ASSERT_EQ(requests.all.size(), 3u);
  EXPECT_EQ(requests.all[0].t0, 0);
  EXPECT_EQ(requests.all[0].X0p, requests.all[1].X0p);
  ASSERT_EQ(d.cycles.size(), 3u);
  EXPECT_EQ(d.cycles[0].index, 0);
  EXPECT_FALSE(d.cycles[0].used);
  EXPECT_EQ(d.cycles[1].index, 1);
  EXPECT_TRUE(d.cycles[1].used);
}

TEST(ClosedLoop, FailedWarmUpDoesNotEndTheDrive) {
  auto s = open_field();
  s.loop.warm_up = true;
  int calls = 0;
  const Drive d =
      drive(s, [&](const auto& r) { return calls++ == 0 ? testing::unsolved(r) : straight_on(r); });
  EXPECT_EQ(d.outcome, Outcome::timeout);
}

TEST(ClosedLoop, FirstHorizonIsStraightOnAndEachPlanTakesOverAtItsStart) {
  auto s = open_field();
  s.loop.timeout = 2;
  // The plan of cycle n has steering rate n/100 at its start.
  int calls = 0;
  const Drive d = drive(s, [&](const planner::Request& r) {
    const double rate = .01 * ++calls;
    return plan_of(
        r,
        [rate](double t) {
          return Control{rate * (1 + t), 0};
        },
        2, 1);
  });
  for (const auto& p : d.plant) {
    const auto horizon = std::floor(p.t / .5);  // 0: no plan yet; n: driven on plan n
    const double expected = p.t == 2 ? .03 * 1.5 : .01 * horizon * (1 + p.t - .5 * horizon);
    EXPECT_NEAR(p.control[vehicle::SR], expected, 1e-12) << p.t;
  }
  // Steering angle: the integral of those rates.
  EXPECT_NEAR(d.plant.back().state[vehicle::SA], .06 * (.5 + .125), 1e-9);
}

TEST(ClosedLoop, SamplesAreCloseUniqueAndIncludeEveryHorizonsEnd) {
  auto s = open_field();
  s.loop.tex = .3;
  s.loop.timeout = 2;  // cuts the seventh horizon short
  const Drive d = drive(s, testing::wavy);
  EXPECT_EQ(d.plant.front().t, 0);
  EXPECT_EQ(d.plant.back().t, 2);
  EXPECT_EQ(d.time, 2);
  std::set<double> times;
  for (std::size_t i = 0; i < d.plant.size(); ++i) {
    EXPECT_TRUE(times.insert(d.plant[i].t).second);
    if (i > 0) {
      EXPECT_LE(d.plant[i].t - d.plant[i - 1].t, .02 + 1e-12);
      EXPECT_GT(d.plant[i].t, d.plant[i - 1].t);
    }
  }
  for (int n = 1; n <= 6; ++n) EXPECT_EQ(times.count(n * .3), 1u) << n;
}

TEST(ClosedLoop, LastPlanGoesOnAndHoldsItsLastControl) {
  auto s = open_field();
  s.loop.on_failure = OnFailure::last_plan;
  s.loop.timeout = 3;
  int calls = 0;
  const Drive d = drive(s, [&](const planner::Request& r) {
    if (++calls > 1) return testing::unsolved(r);
    return plan_of(
        r,
        [](double t) {
          return Control{0, .4 * t};
        },
        1, 1);
  });
  EXPECT_EQ(d.outcome, Outcome::timeout);
  EXPECT_EQ(d.cycles.size(), 6u);
  EXPECT_TRUE(d.cycles[0].used);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_FALSE(d.cycles[i].used);
  for (const auto& p : d.plant) {
    const double expected = p.t < .5 ? 0 : .4 * std::min(p.t - .5, 1.);
    EXPECT_NEAR(p.control[vehicle::JX], expected, 1e-12) << p.t;
  }
  EXPECT_NEAR(d.plant.back().state[vehicle::AX], .2 + .4 * 1.5, 1e-9);
}

TEST(ClosedLoop, LastPlanBeforeAnyPlanIsStraightOn) {
  auto s = open_field();
  s.loop.on_failure = OnFailure::last_plan;
  s.goal = {0, 34, 1.5, 1};
  EXPECT_EQ(drive(s, testing::unsolved).outcome, Outcome::goal);
}

TEST(ClosedLoop, BestIterateIsAskedForAndDrivenOnlyWhereItIsGoodEnough) {
  auto s = open_field();
  s.loop.on_failure = OnFailure::best_iterate;
  s.loop.best_iterate_tol = .01;
  s.loop.timeout = 2.5;
  // Violations of the cycles: the planner judges them by the tolerance it is given.
  const std::vector<double> violation = {0, .009, .02, .01, 0};
  Requests requests;
  const auto plan = requests.answering([&](const planner::Request& r) {
    const std::size_t cycle = requests.all.size();
    auto p = plan_of(r, [&](double) { return Control{0, .1 * static_cast<double>(cycle)}; });
    p.report.solved = violation[cycle - 1] == 0;
    p.report.best_iterate = !p.report.solved && violation[cycle - 1] <= r.best_iterate_tol;
    if (!p.report.solved) p.report.status = planner::PlanStatus::time_limit;
    return p;
  });
  const Drive d = drive(s, plan);
  EXPECT_EQ(d.outcome, Outcome::timeout);
  ASSERT_EQ(d.cycles.size(), 5u);
  for (const auto& request : requests.all) EXPECT_EQ(request.best_iterate_tol, .01);
  const bool driven[] = {true, true, false, true, false};  // the drive ended before the last one
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(d.cycles[i].used, driven[i]) << i;
  EXPECT_EQ(d.cycles[1].plan.report.status, planner::PlanStatus::time_limit)
      << "driven, and yet not called solved";
  for (const auto& p : d.plant) {
    const double plan_of_horizon[] = {0, 1, 2, 2, 4, 4};  // the third goes on with the second's
    EXPECT_NEAR(p.control[vehicle::JX], .1 * plan_of_horizon[static_cast<int>(p.t / .5)], 1e-12);
  }
  EXPECT_EQ(unsolved(d).cycles, 3);
  EXPECT_EQ(unsolved(d).best_iterates, 2);

  for (const auto other : {OnFailure::stop, OnFailure::last_plan}) {
    s.loop.on_failure = other;
    requests.all.clear();
    (void)drive(s, plan);
    for (const auto& request : requests.all) EXPECT_LT(request.best_iterate_tol, 0);
  }
}

TEST(ClosedLoop, DeadlineGivesThePlannerTheHorizonsTime) {
  auto s = open_field();
  s.loop.timeout = s.loop.tex = .3;
  s.loop.solve_time_limit = 7;
  for (const auto& [deadline, limit] :
       {std::pair{Deadline::off, 7.0}, std::pair{Deadline::tex, .3}}) {
    s.loop.deadline = deadline;
    Requests requests;
    (void)drive(s, requests.answering(straight_on));
    ASSERT_EQ(requests.all.size(), 1u);
    EXPECT_EQ(requests.all[0].time_limit, limit);
  }
  s.loop.deadline = Deadline::tex;
  s.loop.solve_time_limit = .2;
  Requests requests;
  (void)drive(s, requests.answering(straight_on));
  EXPECT_EQ(requests.all[0].time_limit, .2) << "the tighter one";
}

TEST(ClosedLoop, OnCycleIsCalledOncePerCycle) {
  auto s = open_field();
  s.loop.warm_up = true;
  s.loop.timeout = 1;
  std::vector<int> seen;
  LoopHooks hooks;
  hooks.on_cycle = [&](const Cycle& cycle) { seen.push_back(cycle.index); };
  (void)drive(s, straight_on, hooks);
  EXPECT_EQ(seen, (std::vector<int>{0, 1, 2}));
}

// A drive's controls, re-integrated by another method, step and model, give its states.
TEST(ClosedLoop, ReintegratedPlansGiveTheDrive) {
  const Drive& d = weaving();
  ASSERT_EQ(d.outcome, Outcome::timeout) << d.message;
  vehicle::State x = weaving_field().start;
  double t = 0;
  for (const auto& cycle : d.cycles) {
    const double end = cycle.t0 + cycle.tex;
    // Driven until `end`: the plan of the cycle before, which starts at this cycle's t0.
    const auto* plan =
        cycle.index == 1 ? nullptr : &d.cycles[static_cast<std::size_t>(cycle.index) - 2].plan;
    std::vector<double> corners = {t};
    if (plan)
      for (const double node : plan->t)
        if (plan->t_start + node > t + 1e-9 && plan->t_start + node < end - 1e-9)
          corners.push_back(plan->t_start + node);
    corners.push_back(end);
    x = vehicle::testing::integrate_rk4(
        x, [&](double at) { return plan ? control_signal(*plan).at(at) : Control{}; }, corners);
    t = end;
    int compared = 0;
    for (const auto& sample : d.plant) {
      if (std::abs(sample.t - end) > 1e-12) continue;
      EXPECT_NEAR(sample.state[vehicle::X], x[vehicle::X], 1e-4 / 100);
      EXPECT_NEAR(sample.state[vehicle::Y], x[vehicle::Y], 1e-4 / 100);
      EXPECT_NEAR(sample.state[vehicle::PSI], x[vehicle::PSI], 1e-5 / 100);
      EXPECT_NEAR(sample.state[vehicle::SA], x[vehicle::SA], 1e-5 / 100);
      ++compared;
    }
    EXPECT_GE(compared, end > d.time ? 0 : 1) << end;
  }
}

// The same from the recorded samples alone, as somebody with the table of the drive would do it.
TEST(ClosedLoop, ReintegratedSamplesGiveTheDrive) {
  const Drive& d = weaving();
  vehicle::State x = weaving_field().start;
  for (std::size_t i = 0; i + 1 < d.plant.size(); ++i) {
    const auto &a = d.plant[i], &b = d.plant[i + 1];
    const auto control = [&](double t) {
      const double share = (t - a.t) / (b.t - a.t);
      return Control{a.control[0] + share * (b.control[0] - a.control[0]),
                     a.control[1] + share * (b.control[1] - a.control[1])};
    };
    x = vehicle::testing::integrate_rk4(x, control, {a.t, b.t});
    EXPECT_NEAR(b.state[vehicle::X], x[vehicle::X], 1e-4 / 100);
    EXPECT_NEAR(b.state[vehicle::Y], x[vehicle::Y], 1e-4 / 100);
    EXPECT_NEAR(b.state[vehicle::PSI], x[vehicle::PSI], 1e-5 / 100);
  }
}

}  // namespace
}  // namespace slalom::sim
