// What is asked of planners, and recorded of them: numbers of no cycle are refused.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "ocp/messages.hpp"
#include "planner/line_scenes.hpp"
#include "planner/scenes.hpp"
#include "slalom/planner/many.hpp"
#include "slalom/planner/recording.hpp"

namespace slalom::planner {
namespace {

using test::refusal;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Wrong {
  const char* what;
  std::function<void(Request&)> change;
};

const std::vector<Wrong>& wrongs() {
  const auto time = [](double t0, double tex) {
    return [=](Request& r) {
      r.t0 = t0;
      r.t_start = t0 + tex;
    };
  };
  static const std::vector<Wrong> table = {
      {"state: found x = nan", [](Request& r) { r.X0p[vehicle::X] = kNaN; }},
      {"state: found psi = -inf", [](Request& r) { r.X0p[vehicle::PSI] = -kInf; }},
      {"state: found ux = 1e+18", [](Request& r) { r.X0p[vehicle::UX] = 1e18; }},
      {"t0: found nan", time(kNaN, .5)},
      {"t0: found 1e+16", time(1e16, .5)},
      {"t0: found -inf", time(-kInf, .5)},
      {"t_start - t0: found nan", time(0, kNaN)},
      {"t_start - t0: found -1", time(0, -1)},
      {"t_start - t0: found 10000", time(0, 1e4)},
      {"tex: found nan", [](Request& r) { r.tex = kNaN; }},
      {"tex: found 1e-300", [](Request& r) { r.tex = 1e-300; }},
      {"tex: found -0.5", [](Request& r) { r.tex = -.5; }},
      {"time_limit: found nan", [](Request& r) { r.time_limit = kNaN; }},
      {"time_limit: found -1", [](Request& r) { r.time_limit = -1; }},
      {"clock_limit: found nan", [](Request& r) { r.clock_limit = kNaN; }},
      {"best_iterate_tol: found nan", [](Request& r) { r.best_iterate_tol = kNaN; }},
      {"best_iterate_tol: found inf", [](Request& r) { r.best_iterate_tol = kInf; }},
  };
  return table;
}

/// E_A by each method.
std::vector<Scene> by_each_method() {
  Scene verified = E_A();
  verified.planner.method = Method::verified;
  return {E_A(), verified, by_P_L()};
}

TEST(Request, NumbersOfNoCycleAreRefusedByEveryPlanner) {
  for (const Scene& scene : by_each_method()) {
    Planner planner(scene);
    for (const Wrong& wrong : wrongs()) {
      Request request = scene.first;
      wrong.change(request);
      const auto found = refusal([&] { (void)planner.plan(request); });
      EXPECT_EQ(found.rfind(std::string("plan: ") + wrong.what, 0), 0u) << found;
      const auto many = refusal([&] { (void)plan_many(scene, {scene.first, request}, 1); });
      EXPECT_EQ(many.rfind(std::string("plan_many: request 1: ") + wrong.what, 0), 0u) << many;
    }
  }
}

TEST(Request, TheTimeOfTheDayAndLimitsOfNothingAreTaken) {
  for (Scene scene : by_each_method()) {
    scene.first.time_limit = scene.first.clock_limit = 0;
    scene.first.t0 = 1.8e9;
    scene.first.t_start = scene.first.t0 + .5;
    EXPECT_EQ(refusal([&] { (void)Planner(scene).plan(scene.first); }), "accepted");
  }
}

/// The first solve of a planner, as it is recorded.
Recording recorded(const Scene& scene) {
  Planner planner(scene);
  std::vector<Recording> recordings;
  planner.record({[](const SolveReport&) { return true; },
                  [&](const Recording& r) { recordings.push_back(r); }});
  (void)planner.plan(scene.first);
  EXPECT_EQ(recordings.size(), 1u);
  return recordings.at(0);
}

TEST(Recording, AStartOfAnotherSizeIsRefusedBeforeItIsRead) {
  Scene on_road = E_A();  // where it is on it is a state of the start
  on_road.road = made_road({{200, -50, 60, 60}, {200, 175, 60, 60}, {200, 400, 60, 60}}, false);
  for (const Scene& scene : {E_A(), on_road, by_P_L()}) {
    const Recording whole = recorded(scene);
    EXPECT_TRUE(replay(whole, scene).same);
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, whole.start.x.size() - 1}) {
      Recording wrong = whole;
      wrong.start.x.resize(size);
      wrong.start.x.shrink_to_fit();
      const auto found = refusal([&] { (void)replay(wrong, scene); });
      EXPECT_NE(found.find("start: x"), std::string::npos) << found;
    }
    Recording wrong = whole;
    wrong.X0p[vehicle::UX] = kNaN;
    EXPECT_NE(refusal([&] { (void)replay(wrong, scene); }), "accepted");
  }
}

/// What is measured beyond the road's edge may be nearest to another branch of it.
TEST(Recording, OfARoadThatComesBackBesideItselfIsOfTheVehiclesBranch) {
  Scene scene = by_P_L();
  scene.road = narrow_loop();
  Planner planner(scene);
  std::vector<Recording> recordings;
  planner.record({[](const SolveReport&) { return true; },
                  [&](const Recording& r) { recordings.push_back(r); }});
  Request request = scene.first;
  request.X0p = {0, 0, 0, 0, 0, 0, 10, 0};
  (void)planner.plan(request);
  request.X0p[vehicle::X] = 5;
  request.X0p[vehicle::Y] = 4.3;
  request.t0 += .5;
  request.t_start += .5;
  (void)planner.plan(request);
  ASSERT_GE(recordings.size(), 2u);
  EXPECT_GT(scene.road->project({5, 4.3}).s, 200) << "the nearest place is on the other branch";
  EXPECT_NEAR(recordings.back().s.value(), 25, 1);
  for (const auto& r : recordings) EXPECT_TRUE(replay(r, scene).same);
}

RecordedPlan recorded_plan() {
  RecordedPlan plan;
  plan.tex = .5;
  plan.wheel_load = 500;
  for (const double t : {.5, .55, .6}) {
    plan.t.push_back(t);
    plan.states.push_back({200, 8.5 + 17 * (t - .5), 0, 0, 1.5, 0, 17, 0});
    plan.controls.push_back({0, 0});
  }
  return plan;
}

TEST(Recording, OfAMotionThatNoPlannerMadeIsRefused) {
  const Scene scene = E_A();
  EXPECT_EQ(refusal([&] { (void)verify_again(recorded_plan(), scene); }), "accepted");
  const auto expect = [&](const std::function<void(RecordedPlan&)>& change, const char* message) {
    RecordedPlan plan = recorded_plan();
    change(plan);
    const auto found = refusal([&] { (void)verify_again(plan, scene); });
    EXPECT_NE(found.find(message), std::string::npos) << found;
  };
  expect([](auto& p) { p.t = {.5, .55, 1e18}; }, "t: found 1e+18");
  expect([](auto& p) { p.t = {.5, .55, kInf}; }, "t: found inf");
  expect([](auto& p) { p.t = {.5, .55, kNaN}; }, "t: found nan");
  expect([](auto& p) { p.t = {.5, .4, .6}; }, "t: found 0.4 after 0.5");
  expect([](auto& p) { p.t = {.5, .55, 9}; }, "t: found 9 after 0.55");
  expect([](auto& p) { p.t.resize(1); }, "t: found 1 times, expected at least 2");
  expect([](auto& p) { p.t0 = -kInf; }, "t0: found -inf");
  expect([](auto& p) { p.tex = 0; }, "tex: found 0");
  expect([](auto& p) { p.tex = kNaN; }, "tex: found nan");
  expect([](auto& p) { p.tex = 1e-300; }, "tex: found 1e-300");
  expect([](auto& p) { p.states.pop_back(); }, "states and controls: found 2 rows");
  expect([](auto& p) { p.states[1][0] = kNaN; }, "states: found NaN or infinity");
  expect([](auto& p) { p.controls[2][1] = kInf; }, "controls: found NaN or infinity");
}

}  // namespace
}  // namespace slalom::planner
