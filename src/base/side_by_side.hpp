#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "slalom/base/error.hpp"

namespace slalom {

/// Does `count` independent pieces of work on several threads, of which the calling one is the
/// first. Each thread takes the next piece that none has begun.
class SideBySide {
 public:
  /// Makes, on the thread that is to use it, what does a piece: it is called with the piece's
  /// index.
  using Worker = std::function<void(std::size_t)>;
  using MakeWorker = std::function<Worker()>;

  /// `threads`: 0 for as many as there are processors; no more are used than there are pieces, or
  /// than the system gives.
  /// Throws InvalidValue for a negative number, with `where`. `poll`, which may be empty, says
  /// whether to end soon; it is called on this thread alone.
  SideBySide(const std::string& where, std::size_t count, int threads, std::function<bool()> poll)
      : count_(count), threads_(threads_for(where, threads)), poll_(std::move(poll)) {}

  /// Whether the work is to end soon: a piece failed, or `poll` said so. For the workers to ask.
  bool ending() {
    if (std::this_thread::get_id() == caller_ && poll_ && poll_()) ending_ = true;
    return ending_.load(std::memory_order_relaxed);
  }

  /// Until all pieces are done. What a piece or the making of a worker throws is thrown here, once
  /// all threads have ended: of several, the one of the lowest index. No piece is begun after that.
  void run(const MakeWorker& make) {
    const std::size_t wanted = std::min(static_cast<std::size_t>(threads_), count_);
    std::vector<std::thread> others;
    others.reserve(wanted);
    try {
      while (others.size() + 1 < wanted) others.emplace_back([&] { work(make); });
    } catch (const std::system_error&) {
      // No more threads are to be had: those that there are do all pieces.
    }
    working_ = others.size() + 1;
    work(make);
    wait();
    for (auto& thread : others) thread.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  static constexpr std::chrono::milliseconds kPollAfter{20};

  void work(const MakeWorker& make) {
    std::size_t index = std::numeric_limits<std::size_t>::max();
    try {
      const Worker worker = make();
      while (!failed_.load() && (index = next_++) < count_) worker(index);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_ || index < failed_index_) {
        error_ = std::current_exception();
        failed_index_ = index;
      }
      failed_ = ending_ = true;
    }
    const std::lock_guard lock(mutex_);
    ++done_;
    changed_.notify_one();
  }
  void wait() {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, kPollAfter, [&] { return done_ == working_; })) {
      lock.unlock();
      (void)ending();
      lock.lock();
    }
  }
  static int threads_for(const std::string& where, int asked) {
    if (asked < 0)
      throw InvalidValue(where + ": threads", std::to_string(asked),
                         "a number of threads, or 0 for as many as there are processors");
    if (asked > 0) return asked;
    const unsigned processors = std::thread::hardware_concurrency();
    return processors > 0 ? static_cast<int>(processors) : 1;
  }

  const std::size_t count_;
  const int threads_;
  const std::function<bool()> poll_;
  const std::thread::id caller_ = std::this_thread::get_id();
  std::size_t working_ = 1, done_ = 0, failed_index_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> ending_ = false, failed_ = false;
  std::exception_ptr error_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace slalom
