#pragma once

#include <gtest/gtest.h>

#include "slalom/planner/plan.hpp"

namespace slalom::planner {

inline void expect_solved(const Plan& plan) {
  EXPECT_TRUE(plan.report.solved) << plan.report.status_text() << ", "
                                  << plan.report.worst_constraint;
  // Section 3, "Solved": what the checker recomputed from the answer.
  EXPECT_LE(plan.report.worst_violation, 1e-6) << plan.report.worst_constraint;
  EXPECT_LE(plan.report.stationarity, 1e-3);
  EXPECT_LE(plan.report.complementarity, 0.01);
}

inline void expect_same(const Plan& a, const Plan& b) {
  EXPECT_EQ(a.tf, b.tf);
  EXPECT_EQ(a.states, b.states);
  EXPECT_EQ(a.controls, b.controls);
  EXPECT_EQ(a.report.iterations, b.report.iterations);
}

}  // namespace slalom::planner
