#pragma once

#include <string>
#include <vector>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::study {

/// How a drive ended, for people: "Reached the goal", "Crashed into O2", ...
std::string outcome_words(const sim::Drive& drive);

/// Wall-clock or CPU times of the cycles on the clock, warm-up left out [s].
std::vector<double> solve_times(const sim::Drive& drive, bool cpu = false);

/// NaN for no values.
double median(std::vector<double> values);
double greatest(const std::vector<double>& values);
double mean_speed(const sim::Drive& drive);  ///< of ux over time [m/s]; NaN without samples

/// State at absolute time t [s] by linear interpolation of the samples; the first or last one
/// outside of them. The drive must have samples.
vehicle::State state_at(const sim::Drive& drive, double t);

}  // namespace slalom::study
