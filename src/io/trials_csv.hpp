#pragma once

#include <string>

#include "slalom/study/sweep_table.hpp"

namespace slalom::io {

/// The first line of trials.csv.
std::string trials_csv_head(const study::SweepTable& study);
/// The line of a trial.
std::string trials_csv_row(const study::SweepTable& study, const study::TrialRecord& record);

}  // namespace slalom::io
