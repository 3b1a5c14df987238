#pragma once

#include <string>

#include "slalom/report/sweep_table.hpp"

namespace slalom::sweep {

/// The first line of trials.csv.
std::string trials_csv_head(const report::SweepTable& study);
/// The line of a trial.
std::string trials_csv_row(const report::SweepTable& study, const report::TrialRecord& record);

}  // namespace slalom::sweep
