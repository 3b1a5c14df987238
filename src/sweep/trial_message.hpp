#pragma once

#include <functional>
#include <string>

#include "slalom/report/sweep_table.hpp"
#include "slalom/sim/drive.hpp"
#include "slalom/sim/scenario.hpp"

namespace slalom::sweep {

/// What a worker is asked: one line of JSON.
struct TrialOrder {
  std::string resolved;  ///< the scenario, as to_yaml gives it
  std::string kernels;   ///< instruction set
  std::string folder;    ///< where the drive is kept; empty: nowhere
};
std::string to_line(const TrialOrder& order);
TrialOrder parse_order(const std::string& line);

/// What it answers: the drive's figures, or why its files could not be written.
struct TrialAnswer {
  report::TrialRecord record;  ///< figures of the drive alone
  std::string not_written;
};
std::string to_line(const TrialAnswer& answer);
TrialAnswer parse_answer(const std::string& line);

/// Drives a trial, on its instruction set, which stays selected. A drive that is interrupted leaves
/// no files.
TrialAnswer run_trial(const TrialOrder& order, const std::function<bool()>& interrupted = {});

/// The figures of a drive of `scenario`.
report::TrialRecord record_of(const sim::Scenario& scenario, const sim::Drive& drive);

}  // namespace slalom::sweep
