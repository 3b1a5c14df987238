#pragma once

#include <ctime>

namespace slalom {

/// Seconds of this thread's processor time and of the wall clock since construction.
class Timer {
 public:
  double cpu() const { return now(CLOCK_THREAD_CPUTIME_ID) - cpu_; }
  double wall() const { return now(CLOCK_MONOTONIC) - wall_; }

 private:
  static double now(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double cpu_ = now(CLOCK_THREAD_CPUTIME_ID);
  double wall_ = now(CLOCK_MONOTONIC);
};

}  // namespace slalom
