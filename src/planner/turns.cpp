#include "turns.hpp"

#include <utility>

namespace slalom::planner {

Turns::~Turns() {
  if (!thread_.joinable()) return;
  cancel();
  ending_ = true;
  to_work_.release();
  thread_.join();
}

void Turns::begin(std::function<void()> work) {
  cancel();
  work_ = std::move(work);
  under_way_ = true;
  wants_more_ = false;
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
}

void Turns::go_on(const Limit& limit) {
  if (!under_way_) return;
  limit_ = limit;
  spent_ = 0;
  wants_more_ = false;
  to_work_.release();
  to_owner_.acquire();
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void Turns::cancel() {
  if (!under_way_) return;
  cancelled_ = true;
  to_work_.release();
  to_owner_.acquire();
  cancelled_ = false;
  error_ = nullptr;
}

void Turns::run() {
  for (;;) {
    to_work_.acquire();
    if (ending_) return;
    timer_ = Timer();
    try {
      if (!cancelled_) work_();
    } catch (...) {
      error_ = std::current_exception();
    }
    cpu_s_ += timer_.cpu();
    under_way_ = false;
    to_owner_.release();
  }
}

void Turns::pause() {
  cpu_s_ += timer_.cpu();
  to_owner_.release();
  to_work_.acquire();
  timer_ = Timer();
}

bool Turns::spend(double work) {
  spent_ += work;
  work_done_ += work;
  if (!cancelled_ && (spent_ >= limit_.work || left_s() <= 0)) pause();
  return cancelled_;
}

bool Turns::wait_for(double cpu_s) {
  if (!cancelled_ && left_s() < cpu_s) {
    wants_more_ = true;
    pause();
  }
  return !cancelled_ && left_s() >= cpu_s;
}

}  // namespace slalom::planner
