#pragma once

#include <vector>

namespace slalom::paper {

/// A median, or a ratio of two, with its 95 % interval; NaN for no values. An interval that there
/// is not, for there are too few values, has NaN for its ends.
struct Estimate {
  double value = 0, lo = 0, hi = 0;
};

/// Median with an interval from the order statistics (binomial, whatever the distribution). Of
/// fewer than six values there is none: the median lies beyond all of five in 6.25 % of all draws.
Estimate median_interval(std::vector<double> values);

/// Ratio of the medians of two samples, `after` over `before`, with a bootstrap interval of 2000
/// draws, the same on every machine.
Estimate ratio_interval(const std::vector<double>& before, const std::vector<double>& after);

/// Each item's ratio, `after` over `before`, as far as both lists go: median and interval.
Estimate paired_interval(const std::vector<double>& before, const std::vector<double>& after);

}  // namespace slalom::paper
