// Many plans at once are those that planners just made would come to.

#include "slalom/planner/many.hpp"

#include <gtest/gtest.h>

#include "planner/scenes.hpp"
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

TEST(ManyPlans, HaveTheBitsOfOneAloneOnAnyNumberOfThreads) {
  const Scene scene = E_B();
  const auto requests = some_of(scene);
  for (const int threads : {1, 2, 4}) {
    const auto plans = plan_many(scene, requests, threads);
    ASSERT_EQ(plans.size(), requests.size());
    for (std::size_t i = 0; i < plans.size(); ++i) {
      const Plan alone = Planner(scene).plan(requests[i]);
      EXPECT_TRUE(plans[i].report.solved);
      EXPECT_EQ(plans[i].states, alone.states) << i << " on " << threads;
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
