#pragma once

#include <vector>

#include "../io/json_file.hpp"
#include "evaluate.hpp"

namespace slalom::paper {

/// JSON has no NaN: what is not there is null.
io::Json number_or_null(double value);

/// Passes by planner; of the first two, the second's share over the first's and Fisher's exact p.
io::Json counts_json(const std::vector<report::PublishedSweep::Count>& counts);

/// The tables of a sweep: passes, real-time factor and probability of safety at each execution
/// horizon, the same where O2 is slower, and how trials end.
io::Json sweep_json(const report::SweepTable& table, const std::vector<SweepTrial>& trials,
                    const report::PublishedSweep& published);

}  // namespace slalom::paper
