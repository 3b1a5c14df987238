// Receding horizons: modes, horizons and plants.

#include "slalom/ocp/mpc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ocp/cart.hpp"
#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"
#include "slalom/ocp/interpolant.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

int iterations(const MpcResult& result) {
  return std::accumulate(result.cycles.begin(), result.cycles.end(), 0,
                         [](int sum, const MpcCycle& c) { return sum + c.solution.iterations; });
}

TEST(Mpc, ComesToItsGoalAndPredictsTheModelsPlant) {
  Cart cart;
  const auto result = Mpc(cart.problem, cart.settings()).run({-2, 0});
  ASSERT_EQ(result.status, MpcStatus::goal) << result.message;
  EXPECT_NEAR(result.states.back()[0], 1, 0.01);
  EXPECT_NEAR(result.states.back()[1], 0, 0.01);
  ASSERT_GT(result.cycles.size(), 8u);
  for (std::size_t k = 0; k < result.cycles.size(); ++k) {
    const MpcCycle& cycle = result.cycles[k];
    EXPECT_EQ(cycle.index, static_cast<int>(k) + 1);
    EXPECT_TRUE(cycle.used);
    EXPECT_NEAR(cycle.t, 0.25 * static_cast<double>(k), 1e-12);
    EXPECT_EQ(cycle.t_plan, cycle.t + 0.25);
    EXPECT_EQ(cycle.t_swap, cycle.t_plan);
    EXPECT_NEAR(cycle.solution.trajectory.t0, cycle.t_plan, 1e-12);
    EXPECT_NEAR(cycle.solution.tf(), cycle.t_plan + 4, 1e-12);  // fixed, moving
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(cycle.x0[i], cycle.arrived[i], 1e-7);
  }
  // Until the first plan takes effect nothing is driven.
  for (std::size_t k = 0; k < result.t.size() && result.t[k] < 0.25 - 1e-9; ++k) {
    EXPECT_EQ(result.states[k][0], -2);
    EXPECT_EQ(result.controls[k][0], 0);
  }
  EXPECT_TRUE(std::is_sorted(result.t.begin(), result.t.end()));
}

TEST(Mpc, InstantPlansTakeEffectWhereTheyBegin) {
  Cart cart;
  auto settings = cart.settings();
  settings.planning = Planning::instant;
  const auto result = Mpc(cart.problem, settings).run({-2, 0});
  ASSERT_EQ(result.status, MpcStatus::goal) << result.message;
  EXPECT_EQ(result.cycles.front().t_swap, 0);
  EXPECT_GT(result.controls.front()[0], 0.9);
  const auto later = Mpc(cart.problem, cart.settings()).run({-2, 0});
  EXPECT_NEAR(later.t.back() - result.t.back(), 0.25, 1e-9);  // what the first plan waited for
}

TEST(Mpc, MeasuredPlansAreLateAndReadAtTheirOwnTime) {
  Cart cart;
  auto settings = cart.settings();
  settings.planning = Planning::measured;
  settings.max_cycles = 3;
  Mpc mpc(cart.problem, settings);
  EXPECT_EQ(mpc.step({-2, 0}, 0), MpcStatus::running);
  const MpcCycle& cycle = mpc.cycles().back();
  EXPECT_EQ(cycle.t_plan, 0);
  EXPECT_EQ(cycle.t_swap, 0.25);
  EXPECT_EQ(cycle.x0, (std::vector<double>{-2, 0}));
  EXPECT_EQ(mpc.controls(0.1)[0], 0);
  EXPECT_NEAR(mpc.controls(0.25)[0], cycle.solution.control("u")[2], 0.1);  // 1.25 intervals in
  EXPECT_EQ(Mpc(cart.problem, settings).run({-2, 0}).status, MpcStatus::cycle_limit);
}

/// From the exact answer of a linear problem each plan is the rest of the last one.
TEST(Mpc, ShrinkingHorizonFollowsTheOptimumToItsEnd) {
  const auto form = least_energy();
  const auto result =
      Mpc(form.problem, {.tex = 0.1, .planning = Planning::instant, .horizon = Horizon::shrinking})
          .run({0, 0});
  ASSERT_EQ(result.status, MpcStatus::horizon_over) << result.message;
  EXPECT_EQ(result.cycles.size(), 10u);
  EXPECT_NEAR(result.t.back(), 1, 1e-12);
  for (std::size_t k = 0; k < result.t.size(); ++k)
    EXPECT_NEAR(result.states[k][0], form.states(result.t[k])[0], 1e-5);
  // With prediction the first cycle drives on nothing, and the last on a plan made before.
  const auto late = Mpc(form.problem, {.tex = 0.1, .horizon = Horizon::shrinking}).run({0, 0});
  ASSERT_EQ(late.status, MpcStatus::horizon_over) << late.message;
  EXPECT_EQ(late.cycles.size(), 9u);
  EXPECT_NEAR(late.t.back(), 1, 1e-12);
  EXPECT_NEAR(late.states.back()[0], 1, 1e-5);
}

/// NLOptControl's own test: the moon lander with free final time.
TEST(Mpc, LandsOnTheMoonWithAFreeHorizon) {
  // Full thrust to the end leaves no margin: without its tolerances the first error of a plan is
  // one too many.
  auto form = moon_lander();
  form.problem.final_time({0.01, 20}, 5);
  for (const auto& state : form.problem.states())
    form.problem.final_bounds(state.symbol, {-0.1, 0.1});
  const MpcSettings settings{.solve = {.mesh = Mesh::uniform(20), .scheme = trapezoidal()},
                             .tex = 0.2,
                             .goal = {{"h", 0, 0.1}, {"v", 0, 0.1}},
                             .start_tolerance = {{"h", 0.1}, {"v", 0.1}}};
  const auto result = Mpc(form.problem, settings).run({10, -2});
  EXPECT_TRUE(result.status == MpcStatus::goal || result.status == MpcStatus::expanded_goal)
      << to_string(result.status) << ": " << result.message;
  EXPECT_NEAR(result.states.back()[0], 0, 0.2);
  EXPECT_NEAR(result.states.back()[1], 0, 0.2);
  EXPECT_NEAR(result.t.back(), solve(moon_lander().problem).tf(), 0.5);
  EXPECT_LT(result.t.back(), result.cycles.front().solution.tf() + 0.5);
}

TEST(Mpc, JudgesTheGoalWhereAPlanShorterThanACycleEnds) {
  Problem p("dash");
  const Expr x = p.state("x"), u = p.control("u", {-1, 1});
  p.dynamics(x, u);
  p.mayer("duration", p.final_time());
  p.final_bounds(x, Bounds::equal(1));
  p.final_time({0.01, 5}, 1);
  const auto run = [&](double drift, double tolerance) {
    MpcSettings settings{.tex = 0.3, .goal = {{"x", 1, tolerance}}};
    settings.plant = System{"drifting",
                            {"x"},
                            {"u"},
                            [drift](double, std::span<const double>, std::span<const double> u,
                                    std::span<double> rates) { rates[0] = u[0] + drift; }};
    return Mpc(p, settings).run({0});
  };
  const auto met = run(0, 1e-4);
  EXPECT_EQ(met.status, MpcStatus::goal) << met.message;
  EXPECT_NEAR(met.t.back(), 1.3, 1e-3);  // the plan's end, not the cycle's
  EXPECT_EQ(run(0.1, 0.018).status, MpcStatus::expanded_goal);
  const auto missed = run(0.1, 0.001);
  EXPECT_EQ(missed.status, MpcStatus::goal_missed) << missed.message;
  EXPECT_NE(missed.message.find("tolerances from the goal"), std::string::npos);
}

TEST(Mpc, DrivesAPlantOtherThanTheModel) {
  Cart cart;
  auto settings = cart.settings();
  settings.plant = lagging_cart();
  const auto result = Mpc(cart.problem, settings).run({0, 0, -2});
  ASSERT_EQ(result.status, MpcStatus::goal) << result.message;
  EXPECT_EQ(result.plant_states, (std::vector<std::string>{"thrust", "v", "x"}));
  EXPECT_NEAR(result.states.back()[2], 1, 0.01);
  const auto miss = [](const MpcResult& r) {
    double most = 0;
    for (const auto& cycle : r.cycles)
      most = std::max(most, std::fabs(cycle.x0[0] - cycle.arrived[0]));
    return most;
  };
  EXPECT_GT(miss(result), 1e-3);
  settings.measure = [](std::span<const double> plant) {
    return std::vector<double>{plant[2], plant[1]};
  };
  const auto same = Mpc(cart.problem, settings).run({0, 0, -2});
  EXPECT_EQ(same.t, result.t);
  EXPECT_EQ(same.states, result.states);
  settings.plant_known = true;
  EXPECT_LT(miss(Mpc(cart.problem, settings).run({0, 0, -2})), 1e-6);
}

/// Of the cycles' begins k * tex some are less by a bit than the last one's + tex.
TEST(Mpc, DrivesEveryPlanHoweverTimesRound) {
  Cart cart;
  auto settings = cart.settings();
  settings.goal.clear();
  settings.tex = 0.2;
  settings.max_cycles = 20;
  settings.plant = lagging_cart();
  const auto result = Mpc(cart.problem, settings).run({0, 0, -2});
  ASSERT_EQ(result.cycles.size(), 20u) << result.message;
  for (std::size_t k = 1, i = 0; k < result.cycles.size(); ++k) {
    const Solution& plan = result.cycles[k - 1].solution;
    const Interpolant planned(cart.problem, plan.trajectory, plan.mesh, plan.scheme);
    const double begin = result.cycles[k].t, end = begin + settings.tex;
    for (; i < result.t.size() && result.t[i] < end - 1e-6; ++i)
      if (result.t[i] > begin + 1e-6)
        EXPECT_NEAR(result.controls[i][0], planned.controls(result.t[i])[0], 1e-9)
            << "cycle " << k + 1;
  }
}

TEST(Mpc, TakesTheLastPlanWhereTheCallersClockIsEarly) {
  Cart cart;
  Mpc mpc(cart.problem, cart.settings());
  ASSERT_EQ(mpc.step({-2, 0}, 0), MpcStatus::running);
  const double planned = mpc.controls(0.3)[0];
  ASSERT_GT(planned, 0.9);
  ASSERT_EQ(mpc.step({-2, 0}, 0.24), MpcStatus::running);
  EXPECT_EQ(mpc.controls(0.3)[0], planned);
}

TEST(Mpc, PlantsMayTakePlannedStatesAsInputs) {
  Cart cart;
  auto settings = cart.settings();
  settings.plant = System{"follower",
                          {"x"},
                          {"v"},
                          [](double, std::span<const double>, std::span<const double> v,
                             std::span<double> rates) { rates[0] = v[0]; }};
  double speed = 0;
  settings.measure = [&](std::span<const double> plant) {
    return std::vector<double>{plant[0], speed};
  };
  settings.check = [&](const MpcCycle& cycle) {
    speed = cycle.solution.state("v").front();  // the speed at t + tex, when it is measured next
    return std::string();
  };
  const auto result = Mpc(cart.problem, settings).run({-2});
  ASSERT_EQ(result.status, MpcStatus::goal) << result.message;
  EXPECT_NEAR(result.states.back()[0], 1, 0.01);
}

TEST(Mpc, ServesAPlantOutside) {
  Cart cart;
  Mpc mpc(cart.problem, cart.settings());
  const double h = 0.25 / 10;
  double x = -2, v = 0;
  int cycle = 0;
  for (; mpc.status() == MpcStatus::running && cycle < 60; ++cycle) {
    const double t = 0.25 * cycle;
    if (mpc.step({x, v}, t) != MpcStatus::running) break;
    for (int k = 0; k < 10; ++k) {
      const double u = mpc.controls(t + (k + 0.5) * h)[0];
      x += h * v + h * h * u / 2;
      v += h * u;
    }
  }
  EXPECT_EQ(mpc.status(), MpcStatus::goal) << mpc.message();
  EXPECT_EQ(mpc.cycles().size(), static_cast<std::size_t>(cycle));
  EXPECT_NEAR(x, 1, 0.01);
  EXPECT_THROW(mpc.step({x, v}, 100), Error);
}

TEST(Mpc, TheUpdateMayChangeNumbersAndStructure) {
  Cart cart;
  auto settings = cart.settings();
  settings.goal = {{"x", 2, 0.02}, {"v", 0, 0.05}};
  settings.update = [&](Problem& problem, const MpcCycle& cycle) {
    problem.set_parameter(cart.target, cycle.index < 5 ? 1 : 2);
    problem.enable(cart.wall, cycle.index < 4);
  };
  const auto result = Mpc(cart.problem, settings).run({-2, 0});
  EXPECT_EQ(result.status, MpcStatus::goal) << result.message;
  EXPECT_EQ(result.cycles[2].solution.multiplier("wall").values.size(), 41u);
  EXPECT_NE(refusal([&] { (void)result.cycles[4].solution.multiplier("wall"); }), "accepted");
}

TEST(Mpc, ShiftedPlansAndMultipliersSaveIterations) {
  Cart cart;
  auto settings = cart.settings();
  settings.goal.clear();
  settings.max_cycles = 20;
  const auto warm = Mpc(cart.problem, settings).run({-2, 0});
  settings.warm_start = false;
  const auto cold = Mpc(cart.problem, settings).run({-2, 0});
  EXPECT_EQ(warm.status, MpcStatus::cycle_limit);
  EXPECT_LT(iterations(warm), 0.72 * iterations(cold));  // 56, 84; unshifted multipliers: 64
  for (std::size_t k = 0; k < 20; ++k)
    EXPECT_NEAR(warm.cycles[k].solution.objective, cold.cycles[k].solution.objective, 1e-6);
}

TEST(Mpc, WarmsUpAndForgetsCyclesWhenTold) {
  Cart cart;
  auto settings = cart.settings();
  settings.warm_up = true;
  settings.max_cycles = 3;
  const auto result = Mpc(cart.problem, settings).run({-2, 0});
  ASSERT_EQ(result.cycles.size(), 4u);
  EXPECT_EQ(result.cycles[0].index, 0);
  EXPECT_FALSE(result.cycles[0].used);
  EXPECT_EQ(result.cycles[1].t, 0);
  EXPECT_LT(result.cycles[1].solution.iterations, result.cycles[0].solution.iterations);
  settings.keep_cycles = false;
  const auto last = Mpc(cart.problem, settings).run({-2, 0});
  ASSERT_EQ(last.cycles.size(), 1u);
  EXPECT_EQ(last.cycles[0].index, 3);
}

}  // namespace
}  // namespace slalom::ocp
