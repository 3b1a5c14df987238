// Receding horizons that fail, and how they end.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ocp/cart.hpp"
#include "ocp/messages.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/mpc.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

TEST(Mpc, AFailedSolveLeavesTheLastPlanOrEnds) {
  Cart cart;
  auto settings = cart.settings();
  int from = 3, to = 4;
  settings.update = [&](Problem& problem, const MpcCycle& cycle) {
    const bool fail = cycle.index >= from && cycle.index <= to;
    problem.final_bounds(cart.x, fail ? Bounds::equal(9.9) : Bounds{});  // out of reach
  };
  const auto result = Mpc(cart.problem, settings).run({-2, 0});
  ASSERT_EQ(result.status, MpcStatus::goal) << result.message;
  EXPECT_FALSE(result.cycles[2].used);
  EXPECT_FALSE(result.cycles[3].used);
  EXPECT_TRUE(result.cycles[4].used);
  for (const std::size_t k : {2u, 3u})  // the plan of cycle 2, as predicted, was driven
    EXPECT_NEAR(result.cycles[k].arrived[0], result.cycles[k].x0[0], 1e-7);
  settings.max_unsolved = 1;
  const auto twice = Mpc(cart.problem, settings).run({-2, 0});
  EXPECT_EQ(twice.status, MpcStatus::not_solved);
  EXPECT_EQ(twice.cycles.size(), 4u);
  settings.max_unsolved = 3;
  settings.on_unsolved = OnUnsolved::stop;
  const auto stopped = Mpc(cart.problem, settings).run({-2, 0});
  EXPECT_EQ(stopped.status, MpcStatus::not_solved);
  EXPECT_EQ(stopped.cycles.size(), 3u);
  EXPECT_EQ(stopped.message.find("cycle 3 was not solved: infeasible, worst at "), 0u)
      << stopped.message;
  settings.on_unsolved = OnUnsolved::last_plan;
  from = 1;  // and there is no last plan
  EXPECT_EQ(Mpc(cart.problem, settings).run({-2, 0}).cycles.size(), 1u);
}

TEST(Mpc, AStateBeyondItsBoundsIsPutOnThem) {
  Cart cart;
  auto settings = cart.settings();
  settings.planning = Planning::instant;
  settings.start_tolerance = {{"x", 0.1}};
  Mpc mpc(cart.problem, settings);
  EXPECT_EQ(mpc.step({-10.5, 0.2}, 0), MpcStatus::running) << mpc.message();
  const MpcCycle& cycle = mpc.cycles().back();
  EXPECT_EQ(cycle.x0, (std::vector<double>{-10, 0.2}));
  EXPECT_TRUE(cycle.used);
  EXPECT_NEAR(cycle.solution.state("x").front(), -9.9, 1e-6);  // what the tolerance is used for
}

TEST(Mpc, EndsWhereThePlantIsLost) {
  Cart cart;
  auto settings = cart.settings();
  settings.plant = System{
      "explosive",
      {"x", "v"},
      {"u"},
      [](double, std::span<const double> x, std::span<const double>, std::span<double> rates) {
        rates[0] = 1 + x[0] * x[0];
        rates[1] = 0;
      }};
  const auto result = Mpc(cart.problem, settings).run({0.9, 0});
  EXPECT_EQ(result.status, MpcStatus::lost);
  EXPECT_EQ(result.message.find("explosive cannot be integrated past t = 0.8"), 0u)
      << result.message;
  settings.plant_known = true;
  const auto known = Mpc(cart.problem, settings).run({0.9, 0});
  EXPECT_EQ(known.status, MpcStatus::lost);
  EXPECT_NE(known.message.find("cannot predict"), std::string::npos) << known.message;
}

TEST(Mpc, TheCheckStopsIt) {
  Cart cart;
  auto settings = cart.settings();
  settings.check = [](const MpcCycle& cycle) {
    return cycle.index == 4 ? "a cow on the track" : "";
  };
  const auto result = Mpc(cart.problem, settings).run({-2, 0});
  EXPECT_EQ(result.status, MpcStatus::stopped);
  EXPECT_EQ(result.message, "a cow on the track");
  EXPECT_EQ(result.cycles.size(), 4u);
}

TEST(MpcErrors, ASecondRunIsRefused) {
  Cart cart;
  Mpc mpc(cart.problem, cart.settings());
  EXPECT_EQ(mpc.run({-2, 0}).status, MpcStatus::goal);
  EXPECT_THROW((void)mpc.run({-2, 0}), Error);
}

TEST(MpcErrors, NameWhatIsWrong) {
  Cart cart;
  const auto refused = [&](auto change) {
    auto settings = cart.settings();
    change(settings);
    return refusal([&] { (void)Mpc(cart.problem, settings).run({-2, 0}); });
  };
  using S = MpcSettings;
  EXPECT_EQ(refused([](S& s) { s.tex = 0; }), "cart: mpc: found tex = 0, expected a number > 0");
  EXPECT_NE(refused([](S& s) { s.max_cycles = 0; }), "accepted");
  EXPECT_EQ(refused([](S& s) { s.goal[0].state = "vv"; }),
            "cart: mpc: goal: found no state 'vv', expected perhaps 'v'");
  EXPECT_EQ(refused([](S& s) { s.goal[0].tolerance = -1; }),
            "cart: mpc: goal x: found 1 with tolerance -1, expected a finite value and a finite "
            "tolerance >= 0");
  EXPECT_EQ(refused([](S& s) {
              s.first_controls = {1, 2};
            }),
            "cart: mpc: first_controls: found 2, expected 1, one for each control, or none");
  EXPECT_EQ(refused([](S& s) {
              s.start_tolerance = {{"y", 1}};
            }),
            "cart: mpc: start_tolerance: found no state 'y', expected a state of this problem");
  EXPECT_EQ(refused([](S& s) {
              s.plant = lagging_cart();
              s.plant->controls = {"w"};
            }),
            "lagging cart: input: found 'w', expected a control or state of the problem");
  EXPECT_EQ(
      refused([](S& s) {
        s.plant = lagging_cart();
        s.plant->states = {"thrust", "speed", "x"};
      }),
      "lagging cart: state to measure: found 'v', expected a function `measure`, for the plant "
      "has no such state");
  Mpc mpc(cart.problem, cart.settings());
  EXPECT_EQ(refusal([&] { mpc.step({1}, 0); }), "cart: mpc: measured states: found 1, expected 2");
  EXPECT_EQ(refusal([&] {
              mpc.step({1, std::nan("")}, 0);
            }),
            "cart: mpc: measured states: found v = nan, expected a finite number");
  cart.problem.initial_time({0, 1}, 0);
  EXPECT_EQ(refused([](S&) {}),
            "cart: mpc: found t0 free from 0 to 1, expected a t0 that each cycle can set");
}

}  // namespace
}  // namespace slalom::ocp
