#pragma once

#include <cstdint>
#include <vector>

namespace slalom::report {

/// An estimate's confidence interval.
struct Interval {
  double lo = 0, hi = 0;
};

/// Exact interval of a proportion k of n (Clopper and Pearson 1934); [0, 1] for n = 0. Throws
/// InvalidValue unless 0 <= k <= n and 0 < confidence < 1.
Interval clopper_pearson(std::int64_t k, std::int64_t n, double confidence = 0.95);

/// A fourfold table: two groups, how many in each passed and failed.
struct Fourfold {
  std::int64_t passed1 = 0, failed1 = 0, passed2 = 0, failed2 = 0;
};

/// Two-sided p-value of Fisher's exact test: the probability, with all margins held, of tables no
/// more likely than this one (as R's fisher.test has it). Throws InvalidValue for negative counts.
double fisher_exact(const Fourfold& table);

/// Odds ratio of the second group to the first with its interval by Woolf's logit; 0.5 is added to
/// every count when one is zero (Haldane, Anscombe).
struct OddsRatio {
  double ratio = 0;
  Interval interval;
};
OddsRatio odds_ratio(const Fourfold& table, double confidence = 0.95);

/// Two-sided p-value of McNemar's exact test on pairs: `only1` passed in the first alone, `only2`
/// in the second alone. 1 without such pairs.
double mcnemar_exact(std::int64_t only1, std::int64_t only2);

/// The q-quantile, 0 <= q <= 1, linear between order statistics (R's type 7); NaN for no values.
double quantile(std::vector<double> values, double q);

/// NaN for no values.
double mean(const std::vector<double>& values);

}  // namespace slalom::report
