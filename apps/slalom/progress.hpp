#pragma once

#include <string>

#include "slalom/sim/drive.hpp"
#include "status_line.hpp"

namespace slalom::app {

/// One line on the terminal that follows a drive; nothing when stderr is no terminal.
class Progress {
 public:
  /// `label` starts the line, e.g. "E_C P_D"; `quiet` keeps it away in any case.
  Progress(std::string label, bool quiet);

  void show(const sim::Cycle& cycle);
  /// Takes the line away, so that what is printed next starts clean.
  void clear() { line_.clear(); }

 private:
  std::string label_;
  StatusLine line_;
};

}  // namespace slalom::app
