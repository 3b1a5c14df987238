#pragma once

#include <chrono>
#include <string>

#include "slalom/sweep/sweep.hpp"
#include "status_line.hpp"

namespace slalom::app {

/// One line on the terminal that follows a sweep, with rate and time left; nothing when stderr is
/// no terminal.
class SweepProgress {
 public:
  SweepProgress(std::string label, bool quiet);

  void take(const sweep::SweepEvent& event);
  /// Redraws once in a while.
  void tick();
  /// Takes the line away.
  void clear() { line_.clear(); }

 private:
  std::string text() const;

  std::string label_;
  StatusLine line_;
  std::int64_t total_ = 0, before_ = 0, done_ = 0, passed_ = 0, failed_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace slalom::app
