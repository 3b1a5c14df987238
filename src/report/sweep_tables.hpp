#pragma once

#include <string>

#include "slalom/report/sweep_report.hpp"

namespace slalom::report {

/// Real-time factor and probability of safety over tex, for all speeds of O2 and for the paper's
/// ranges of them; `beside`: with the paper's figures.
std::string horizons_html(const SweepTable& sweep, const PublishedSweep& paper, bool beside);

/// Percentiles of the solve times, a row a planner.
std::string solve_time_table(const SweepTable& sweep);

/// How many cycles had no solved or, of a planner that verifies, no verified plan; a row a planner.
std::string failed_cycle_table(const SweepTable& sweep);

/// For each value of the axis beside tex, the longest execution horizon below which a shorter one
/// does not help.
std::string longest_horizon_table(const SweepTable& sweep);

/// Every pass with how near it came.
std::string pass_table(const SweepTable& sweep);

}  // namespace slalom::report
