#pragma once

#include <optional>

#include "newton.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp::ipm {

/// What a solve may take: iterations, time, the user's patience. The user's callbacks take none of
/// its time.
class Budget final : public Deadline {
 public:
  /// `options` outlive the solve; `timer` has run since its begin.
  void begin(const Options& options, const Timer& timer);
  /// Asked before each iteration, of which there were so many: why it is not to be done, if so. One
  /// as long as the longest yet has to fit into the time limit.
  std::optional<Status> spent(int iterations);
  bool passed() override;

  /// Calls f(), a callback of the user's.
  template <class F>
  void call(F f) {
    const double before = timer_.cpu();
    f();
    callback_s_ += timer_.cpu() - before;
  }
  /// The times of an answer.
  void report(Answer& answer) const;

 private:
  double used_s() const { return timer_.cpu() - callback_s_; }
  bool asked_to_stop();

  const Options* options_ = nullptr;
  Timer timer_;
  double callback_s_ = 0, longest_step_s_ = 0, last_iteration_s_ = 0;
};

}  // namespace slalom::nlp::ipm
