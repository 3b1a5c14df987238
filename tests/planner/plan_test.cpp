#include "slalom/planner/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::planner {
namespace {

TEST(PlanStatus, HasTheWordOfEveryStatusOfASolver) {
  const std::string none = nlp::to_string(static_cast<nlp::Status>(-1));
  int number = 0;
  for (; nlp::to_string(static_cast<nlp::Status>(number)) != none; ++number) {
    const auto status = static_cast<nlp::Status>(number);
    EXPECT_STREQ(to_string(plan_status(status)), nlp::to_string(status));
  }
  // The planner's own begin where the solvers' end.
  EXPECT_EQ(static_cast<int>(PlanStatus::not_confirmed), number);
  EXPECT_STREQ(to_string(PlanStatus::not_confirmed), "not_confirmed");
}

TEST(PlanStatus, ADetailStandsBehindIt) {
  SolveReport report;
  report.status = PlanStatus::time_limit;
  EXPECT_EQ(report.status_text(), "time_limit");
  report.status = PlanStatus::no_prediction;
  report.detail = "the plant cannot be integrated";
  EXPECT_EQ(report.status_text(), "no prediction: the plant cannot be integrated");
}

Plan straight_on() {
  Plan plan;
  plan.t_start = .5;
  for (int k = 0; k <= 8; ++k) {
    plan.t.push_back(.25 * k);
    plan.states.push_back({});
    plan.controls.push_back({.01 * k, 0});
  }
  return plan;
}

TEST(ControlSignalOfAPlan, StartsWithThePlan) {
  const auto signal = control_signal(straight_on());
  EXPECT_EQ(signal.knots().front(), .5);
  EXPECT_EQ(signal.knots().back(), 2.5);
  EXPECT_DOUBLE_EQ(signal.at(1)[vehicle::SR], .02);
}

TEST(ControlSignalOfAPlan, RefusesPlansThatCannotBeDriven) {
  const auto good = straight_on();
  EXPECT_TRUE(usable(good));
  auto plan = good;
  plan.t.clear();
  EXPECT_FALSE(usable(plan));
  EXPECT_THROW(control_signal(plan), Error);
  plan = good;
  plan.controls.pop_back();
  EXPECT_FALSE(usable(plan));
  plan = good;
  plan.controls[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(usable(plan));
  plan = good;
  std::swap(plan.t[2], plan.t[5]);
  EXPECT_FALSE(usable(plan));
  plan = good;
  plan.t_start = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(usable(plan));
}

}  // namespace
}  // namespace slalom::planner
