#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace slalom::app {

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), on_(!quiet && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  clear();
}

void Progress::show(const sim::Cycle& cycle) {
  if (!on_) return;
  const auto& plan = cycle.plan;
  fmt::print(stderr, "\r\x1b[K{}  t {:5.1f} s  cycle {}  solve {:.3f} s of {:g} s  {:.1f} m/s",
             label_, cycle.t0, cycle.index, plan.report.wall_s, cycle.tex, cycle.X0p[vehicle::UX]);
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace slalom::app
