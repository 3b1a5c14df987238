// Many plans at once are those that planners just made would come to.

#include "slalom/planner/many.hpp"

#include <gtest/gtest.h>

#include "planner/expect_plan.hpp"
#include "planner/line_scenes.hpp"
#include "slalom/base/error.hpp"

namespace slalom::planner {
namespace {

std::vector<Request> some_of(const Scene& scene) {
  std::vector<Request> requests;
  for (const double aside : {0.0, 0.3, -0.4, 0.7, 0.1}) {
    requests.push_back(scene.first);
    requests.back().X0p[vehicle::X] += aside;
    requests.back().X0p[vehicle::UX] -= aside;
  }
  return requests;
}

/// E_B by P_E.
Scene verified() {
  Scene scene = E_B();
  scene.planner.method = Method::verified;
  scene.planner.arrival_N = 20;
  scene.planner.search_places = 5000;
  return scene;
}

/// E_B along a wide road.
Scene on_road() {
  Scene scene = E_B();
  scene.road = made_road({{200, -50, 60, 60}, {200, 175, 60, 60}, {200, 400, 60, 60}}, false);
  return scene;
}

TEST(ManyPlans, HaveTheBitsOfOneAloneOnAnyNumberOfThreads) {
  for (const Scene& scene : {E_B(), verified(), on_road(), by_P_L()}) {
    const auto requests = some_of(scene);
    std::vector<Plan> alone;
    for (const Request& request : requests) alone.push_back(Planner(scene).plan(request));
    for (const int threads : {1, 2, 4}) {
      const auto plans = plan_many(scene, requests, threads);
      ASSERT_EQ(plans.size(), requests.size());
      for (std::size_t i = 0; i < plans.size(); ++i) {
        SCOPED_TRACE(std::to_string(i) + " on " + std::to_string(threads));
        EXPECT_TRUE(plans[i].report.solved) << plans[i].report.status_text();
        expect_same(plans[i], alone[i]);
      }
    }
  }
}

/// What was given up when a plan was forgotten counts in none.
TEST(ManyPlans, NothingIsLeftOfAPlanThatWasInterrupted) {
  for (const Scene& scene : {E_B(), verified(), on_road(), by_P_L()}) {
    const Plan alone = Planner(scene).plan(scene.first);
    Planner planner(scene);
    for (const int polls : {1, 2, 3, 5, 8, 13}) {
      Request cut = scene.first;
      int left = polls;
      cut.interrupted = [&left] { return --left < 0; };
      (void)planner.plan(cut);
      planner.reset();
      expect_same(planner.plan(scene.first), alone);
      planner.reset();
    }
  }
}

TEST(ManyPlans, EndWhenInterrupted) {
  const auto plans = plan_many(E_B(), some_of(E_B()), 1, [] { return true; });
  for (const auto& plan : plans) EXPECT_FALSE(plan.report.solved);
}

TEST(ManyPlans, ThrowWhatAPlannerThrows) {
  Scene bad = E_B();
  bad.planner.N = 0;
  EXPECT_THROW((void)plan_many(bad, some_of(bad), 2), InvalidValue);
  EXPECT_THROW((void)plan_many(E_B(), some_of(E_B()), -1), InvalidValue);
}

}  // namespace
}  // namespace slalom::planner
