#pragma once

#include <algorithm>
#include <exception>
#include <functional>
#include <limits>
#include <semaphore>
#include <thread>

#include "slalom/base/timer.hpp"

namespace slalom::planner {

/// Work that is done in turns: it may stop in the middle of a search or a solve until its owner
/// gives it the next one. It has a thread of its own, which runs only while the owner waits in
/// go_on(), so that both may use the same objects without locks, and what comes out depends on what
/// is spent in each turn alone.
class Turns {
 public:
  /// What one turn may take.
  struct Limit {
    double work = std::numeric_limits<double>::infinity();     ///< of what is spent [its unit]
    double cpu_s = std::numeric_limits<double>::infinity();    ///< thread time
    double clock_s = std::numeric_limits<double>::infinity();  ///< by the wall clock
  };

  Turns() = default;
  Turns(const Turns&) = delete;
  Turns& operator=(const Turns&) = delete;
  /// Work under way is cancelled.
  ~Turns();

  // --- its owner's -------------------------------------------------------------------------
  /// Makes `work` what is done from the next turn on. What was under way is cancelled.
  void begin(std::function<void()> work);
  /// One turn of the work under way. An exception of the work is thrown here, and ends it.
  void go_on(const Limit& limit);
  void cancel();
  bool under_way() const { return under_way_; }
  /// The work waits for a turn that is longer than the last one was.
  bool wants_more() const { return wants_more_; }
  double cpu_s() const { return cpu_s_; }     ///< thread time of all turns [s]
  double work() const { return work_done_; }  ///< spent in all turns [its unit]

  // --- the work's --------------------------------------------------------------------------
  /// Notes so much work, and waits for the next turn if this one's is used up. True if the work is
  /// cancelled: it is to end soon.
  bool spend(double work);
  /// Waits for the next turn unless this one has so much time left [s]. Whether there is as
  /// much then, and the work is not cancelled.
  bool wait_for(double cpu_s);

 private:
  void run();
  void pause();
  double left_s() const {
    return std::min(limit_.cpu_s - timer_.cpu(), limit_.clock_s - timer_.wall());
  }

  std::function<void()> work_;
  Limit limit_;
  double spent_ = 0, work_done_ = 0, cpu_s_ = 0;
  bool under_way_ = false, cancelled_ = false, ending_ = false, wants_more_ = false;
  std::exception_ptr error_;
  Timer timer_;  ///< of the turn, in the work's thread
  std::binary_semaphore to_work_{0}, to_owner_{0};
  std::thread thread_;
};

}  // namespace slalom::planner
