#include "status_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace slalom::app {

StatusLine::StatusLine(bool quiet) : on_(!quiet && isatty(STDERR_FILENO) != 0) {}

StatusLine::~StatusLine() {
  clear();
}

void StatusLine::show(const std::string& text) {
  if (!on_) return;
  fmt::print(stderr, "\r\x1b[K{}", text);
  std::fflush(stderr);
  shown_ = true;
}

void StatusLine::clear() {
  if (!shown_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace slalom::app
