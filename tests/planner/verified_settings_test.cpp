// What the settings of a planner that verifies do.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "planner/verified_scenes.hpp"

namespace slalom::planner {
namespace {

Plan first_plan(const std::function<void(Settings&)>& change, Task task = verified_task()) {
  change(task.planner);
  return Planner(task).plan(northwards());
}

/// The candidates that are answers of the OCP.
std::vector<Candidate> solved(const Plan& plan) {
  std::vector<Candidate> list;
  for (const auto& each : plan.candidates)
    if (each.name.ends_with(", solved")) list.push_back(each);
  return list;
}

// A wall 12 m ahead at 17 m/s.
TEST(VerifiedSettings, WhereNothingIsGoodTheySayWhetherAndWhatIsDriven) {
  Task task = verified_task();
  task.obstacles = {{"wall", 0, 14, 60, 2, 0, 0}};
  const Plan least_bad = first_plan([](Settings&) {}, task);
  EXPECT_EQ(least_bad.rung, Rung::least_bad);

  const Plan trusted = first_plan([](Settings& s) { s.verification = false; }, task);
  EXPECT_EQ(trusted.rung, Rung::new_plan);
  EXPECT_FALSE(trusted.certificate.verified) << "it is driven all the same";
  EXPECT_TRUE(usable(trusted));

  const Plan none = first_plan([](Settings& s) { s.fallback = false; }, task);
  EXPECT_EQ(none.rung, Rung::none);
  EXPECT_EQ(none.report.status, PlanStatus::infeasible);
  EXPECT_TRUE(none.empty());
}

/// The plan of a cycle after one that went around a wall, when there is nothing to go around any
/// more.
Plan after_a_detour(const std::function<void(Settings&)>& change) {
  Task task = verified_task();
  task.obstacles = {{"wall", -20, 80, 40, 3, 0, 0}};
  task.planner.search_places = 100'000;
  task.planner.improvement_time = 1;
  change(task.planner);
  Planner planner(task);
  const Plan plan = planner.plan(northwards());
  EXPECT_TRUE(plan.goal_in_range);
  Request request = next(task, northwards(), plan);
  request.obstacles.emplace();
  return planner.plan(request);
}

TEST(VerifiedSettings, ABetterPlanIsLookedForAndDrivenAsTheySay) {
  const auto rung = [](const std::function<void(Settings&)>& change) {
    return after_a_detour(change).rung;
  };
  EXPECT_EQ(rung([](Settings&) {}), Rung::new_plan);
  // It is not so much sooner, not looked for yet, or not found.
  EXPECT_EQ(rung([](Settings& s) { s.hysteresis = 60; }), Rung::rest);
  EXPECT_EQ(rung([](Settings& s) { s.improvement_period = 60; }), Rung::rest);
  EXPECT_EQ(rung([](Settings& s) { s.improvement_time = 1e-9; }), Rung::rest);
}

TEST(VerifiedSettings, TheFallbackOfANewPlanIsTheRestOfTheLast) {
  const Plan better = after_a_detour([](Settings&) {});
  const Candidate* rest = fallback(better);
  ASSERT_NE(rest, nullptr);
  EXPECT_GT(rest->path.back().y, 100) << "it leads to the goal too";
  double aside = 0;
  for (const auto& place : rest->path) aside = std::max(aside, std::fabs(place.x));
  EXPECT_GT(aside, 15) << "around the wall that was";
  const Plan none = after_a_detour([](Settings& s) { s.hysteresis = 60; });
  EXPECT_EQ(fallback(none), nullptr);
  EXPECT_TRUE(none.candidates.front().path.empty()) << "it is the plan itself";
}

TEST(VerifiedSettings, TheOcpHasSoManyIterationsAndSoMuchTime) {
  const Plan plan = first_plan([](Settings&) {});
  EXPECT_FALSE(solved(plan).empty());
  const Plan given_up = first_plan([](Settings& s) { s.arrival_max_iterations = 1; });
  EXPECT_LT(given_up.report.iterations, plan.report.iterations);
  EXPECT_TRUE(solved(given_up).empty());
  EXPECT_TRUE(given_up.certificate.verified) << "the way itself is driven";
  EXPECT_TRUE(solved(first_plan([](Settings& s) { s.arrival_tf_max = 2; })).empty());
}

TEST(VerifiedSettings, TheOcpKeepsItsMarginFromObstacles) {
  const auto clearance = [](double margin) {
    const Plan plan = first_plan([&](Settings& s) { s.arrival_margin = margin; });
    const auto answers = solved(plan);
    EXPECT_FALSE(answers.empty());
    return answers.empty() ? 0 : answers.back().certificate.least_clearance;
  };
  // What is tracked strays from the answer.
  const double less = clearance(0.3), more = clearance(3);
  EXPECT_GT(less, Settings().verified_clearance + 0.3 - 0.1);
  EXPECT_NEAR(more - less, 2.7, 0.5);
}

}  // namespace
}  // namespace slalom::planner
