#pragma once

#include <string>
#include <vector>

#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"
#include "slalom/sim/solve_times.hpp"

namespace slalom::report {

using sim::greatest;
using sim::median;
using sim::solve_times;

/// How a drive ended, for people: "Reached the goal", "Crashed into O2", ...
std::string outcome_words(const sim::Drive& drive);

double mean_speed(const sim::Drive& drive);  ///< of ux over time [m/s]; NaN without samples

/// State at absolute time t [s] by linear interpolation of the samples; the first or last one
/// outside of them. The drive must have samples.
vehicle::State state_at(const sim::Drive& drive, double t);

}  // namespace slalom::report
