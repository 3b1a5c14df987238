#pragma once

#include <string>

namespace slalom::app {

/// One line on the terminal that is written over again and again; nothing when stderr is no
/// terminal.
class StatusLine {
 public:
  /// `quiet` keeps it away in any case.
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  bool on() const { return on_; }
  void show(const std::string& text);
  /// Takes the line away, so that what is printed next starts clean.
  void clear();

 private:
  bool on_;
  bool shown_ = false;
};

}  // namespace slalom::app
