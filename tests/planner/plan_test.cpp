#include "slalom/planner/plan.hpp"

#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace slalom::planner
