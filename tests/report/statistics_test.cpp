#include "slalom/report/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slalom/base/error.hpp"

namespace slalom::report {
namespace {

void expect_relative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected)) << expected;
}

// Reference values by exact rational arithmetic (Fisher) and by bisection of the binomial tails at
// 30 digits (Clopper and Pearson).
TEST(Statistics, FisherAgreesWithExactFractions) {
  expect_relative(fisher_exact({3, 1, 1, 3}), 0.4857142857142857, 1e-12);  // the lady tasting tea
  expect_relative(fisher_exact({0, 5, 5, 0}), 0.007936507936507936, 1e-12);
  expect_relative(fisher_exact({10, 2, 3, 15}), 0.0005367241191434358, 1e-12);
  expect_relative(fisher_exact({22, 378, 148, 252}), 1.331738175427612e-29, 1e-9);  // the paper's
  EXPECT_DOUBLE_EQ(fisher_exact({4, 4, 4, 4}), 1);
  EXPECT_DOUBLE_EQ(fisher_exact({0, 0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(fisher_exact({10, 2, 3, 15}), fisher_exact({3, 15, 10, 2}));
}

TEST(Statistics, ClopperPearsonAgreesWithTheBinomialTails) {
  const auto half = clopper_pearson(5, 10);
  expect_relative(half.lo, 0.1870860284474, 1e-12);
  expect_relative(half.hi, 0.8129139715526, 1e-12);
  const auto paper = clopper_pearson(148, 400);
  expect_relative(paper.lo, 0.3225520140463, 1e-12);
  expect_relative(paper.hi, 0.41938718679215, 1e-12);
  const auto none = clopper_pearson(0, 10);
  EXPECT_EQ(none.lo, 0);
  expect_relative(none.hi, 1 - std::pow(0.025, 0.1), 1e-12);
  const auto all = clopper_pearson(10, 10, 0.9);
  EXPECT_EQ(all.hi, 1);
  expect_relative(all.lo, std::pow(0.05, 0.1), 1e-12);
  const auto nothing = clopper_pearson(0, 0);
  EXPECT_EQ(nothing.lo, 0);
  EXPECT_EQ(nothing.hi, 1);
}

TEST(Statistics, OddsRatioHasWoolfsInterval) {
  const auto odds = odds_ratio({22, 378, 148, 252});
  expect_relative(odds.ratio, 148.0 * 378 / (252 * 22), 1e-14);
  expect_relative(odds.interval.lo, 6.27308123399440, 1e-12);
  expect_relative(odds.interval.hi, 16.2322856157490, 1e-12);
  // A zero adds a half to each.
  expect_relative(odds_ratio({0, 10, 5, 5}).ratio, 5.5 * 10.5 / (5.5 * 0.5), 1e-14);
}

TEST(Statistics, McNemarIsABinomialTestOfTheUnequalPairs) {
  expect_relative(mcnemar_exact(1, 9), 2 * 11 / 1024.0, 1e-12);
  expect_relative(mcnemar_exact(9, 1), 2 * 11 / 1024.0, 1e-12);
  expect_relative(mcnemar_exact(0, 6), 2 / 64.0, 1e-12);
  EXPECT_EQ(mcnemar_exact(0, 0), 1);
  EXPECT_EQ(mcnemar_exact(5, 5), 1);
}

TEST(Statistics, QuantilesAreLinearBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.95), 3.85);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.3), 7);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_DOUBLE_EQ(mean({1, 2, 6}), 3);
  EXPECT_TRUE(std::isnan(mean({})));
}

TEST(Statistics, CountsThatCannotBeAreRefused) {
  EXPECT_THROW((void)fisher_exact({-1, 2, 3, 4}), InvalidValue);
  EXPECT_THROW((void)clopper_pearson(11, 10), InvalidValue);
  EXPECT_THROW((void)clopper_pearson(1, 10, 1), InvalidValue);
  EXPECT_THROW((void)odds_ratio({1, 2, -3, 4}), InvalidValue);
  EXPECT_THROW((void)mcnemar_exact(1, -1), InvalidValue);
}

}  // namespace
}  // namespace slalom::report
