#pragma once

#include <cstdint>

#include "slalom/base/timer.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::ocp {

/// Ends a solve's set-up, which may take longer than the solve, and other work between solves: by
/// the options' time limit, counted from when this was made, or by their callback. One a thread,
/// the innermost, while it lives.
class SetUpWatch {
 public:
  /// Thrown by poll(); whoever made the watch catches it.
  struct Stopped {
    nlp::Status status;
  };

  explicit SetUpWatch(const nlp::Options& options);
  ~SetUpWatch();
  SetUpWatch(const SetUpWatch&) = delete;
  SetUpWatch& operator=(const SetUpWatch&) = delete;

  double seconds() const { return timer_.wall(); }
  /// Ends nothing from now on.
  void over() {
    if (current_ == this) current_ = outer_;
  }

  /// To be called once each step of a loop over points, rows or entries; asks every kSteps steps.
  static void poll() {
    if (current_ != nullptr && (++current_->steps_ & (kSteps - 1)) == 0) current_->ask();
  }
  /// The same at once, where a step takes longer.
  static void ask_now() {
    if (current_ != nullptr) current_->ask();
  }

 private:
  static constexpr std::uint32_t kSteps = 8192;
  void ask() const;

  static thread_local SetUpWatch* current_;
  const nlp::Options& options_;
  SetUpWatch* const outer_;
  const Timer timer_;
  std::uint32_t steps_ = 0;
};

}  // namespace slalom::ocp
