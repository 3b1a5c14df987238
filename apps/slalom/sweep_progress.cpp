#include "sweep_progress.hpp"

#include <fmt/format.h>

#include <cmath>

namespace slalom::app {
namespace {

/// 75 s as 1:15, an hour more as 1:00:00.
std::string clock_text(double seconds) {
  const auto s = std::lround(seconds);
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

}  // namespace

SweepProgress::SweepProgress(std::string label, bool quiet)
    : label_(std::move(label)), line_(quiet) {}

void SweepProgress::take(const sweep::SweepEvent& event) {
  total_ = event.total;
  before_ = event.before;
  done_ = event.done;
  if (event.record == nullptr) return;
  passed_ += event.record->passed();
  failed_ += event.record->outcome == "failed" || event.record->outcome == "invalid";
}

std::string SweepProgress::text() const {
  constexpr int kWidth = 24;
  const auto all = before_ + done_;
  const auto filled = total_ > 0 ? static_cast<int>(kWidth * all / total_) : kWidth;
  auto line = fmt::format("{} [{:#<{}}{:.<{}}] {}/{}", label_, "", filled, "", kWidth - filled, all,
                          total_);
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  if (done_ > 0 && elapsed > 0) {
    const double rate = static_cast<double>(done_) / elapsed;
    line += fmt::format("  {:.3g} a second  {} left", rate,
                        clock_text(static_cast<double>(total_ - all) / rate));
  }
  line += fmt::format("  {} at the goal", passed_);
  if (failed_ > 0) line += fmt::format("  {} failed", failed_);
  return line;
}

void SweepProgress::tick() {
  if (line_.on()) line_.show(text());
}

}  // namespace slalom::app
