#pragma once

#include <vector>

#include "slalom/sim/drive.hpp"

namespace slalom::sim {

/// Wall-clock or CPU times of the cycles on the clock, the warm-up left out [s].
std::vector<double> solve_times(const Drive& drive, bool cpu = false);

/// Of the cycles on the clock, how many were not solved, and in how many of these the best iterate
/// was driven.
struct Unsolved {
  int cycles = 0, best_iterates = 0;
};
Unsolved unsolved(const Drive& drive);

/// The mean of the middle two for an even number; NaN for none.
double median(std::vector<double> values);
/// Of each cycle of the first of several runs, the median of its times in those runs that had as
/// many: runs that go by the clock may end earlier, or later.
std::vector<double> cycle_medians(const std::vector<std::vector<double>>& runs);
/// The least value that so many per cent of them do not exceed (nearest rank); NaN for none.
double percentile(std::vector<double> values, double per_cent);
/// NaN for no values.
double greatest(const std::vector<double>& values);

}  // namespace slalom::sim
