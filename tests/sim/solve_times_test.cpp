#include "slalom/sim/solve_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace slalom::sim {
namespace {

TEST(SolveTimes, TheWarmUpIsLeftOut) {
  Drive drive;
  for (int index : {0, 1, 2}) {
    Cycle cycle;
    cycle.index = index;
    cycle.plan.report.wall_s = 10 - index;
    cycle.plan.report.cpu_s = 20 - index;
    drive.cycles.push_back(cycle);
  }
  EXPECT_EQ(solve_times(drive), (std::vector<double>{9, 8}));
  EXPECT_EQ(solve_times(drive, true), (std::vector<double>{19, 18}));
}

TEST(SolveTimes, PercentilesAreByNearestRank) {
  EXPECT_EQ(percentile({5, 7, 3, 1}, 50), 3);
  EXPECT_EQ(percentile({5, 7, 3, 1}, 51), 5);
  EXPECT_EQ(percentile({5, 7, 3, 1}, 0), 1);
  EXPECT_EQ(percentile({5, 7, 3, 1}, 100), 7);
  EXPECT_TRUE(std::isnan(percentile({}, 99)));
}

TEST(SolveTimes, MedianAndGreatestOfUnsortedValues) {
  EXPECT_EQ(median({5, 1, 3}), 3);
  EXPECT_EQ(median({5, 1, 3, 2}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_EQ(greatest({5, 7, 3}), 7);
  EXPECT_TRUE(std::isnan(greatest({})));
}

TEST(SolveTimes, MediansOfCyclesTakeRunsAsLongAsTheyAre) {
  EXPECT_EQ(cycle_medians({{1, 4, 7}, {3}, {2, 6, 9, 9}}), (std::vector<double>{2, 5, 8}));
  EXPECT_TRUE(cycle_medians({{}, {1}}).empty());
  EXPECT_TRUE(cycle_medians({}).empty());
}

}  // namespace
}  // namespace slalom::sim
