#include "slalom/sweep/worker_pool.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <chrono>
#include <deque>

#include "slalom/base/error.hpp"
#include "worker_process.hpp"

namespace slalom::sweep {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTick = 200;           ///< [ms] between two looks at clock and interruption
constexpr int kMaxFailedStarts = 5;  ///< in a row, before giving up
constexpr double kStartLimit = 30;   ///< [s] for a worker to get ready

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A job and how its attempts ended so far.
struct Attempt {
  PoolJob job;
  int faults = 0;  ///< attempts that died or hung by themselves
  int kills = 0;   ///< attempts that others ended: they say nothing of the job
};

class Pool {
 public:
  Pool(const PoolSettings& settings, const PoolHooks& hooks) : settings_(settings), hooks_(hooks) {}

  bool run() {
    for (;;) {
      if (hooks_.interrupted && hooks_.interrupted()) return false;
      staff();
      if (seats_.empty() && !later_) return true;
      wait();
      if (hooks_.tick) hooks_.tick();
    }
  }

 private:
  /// A worker and what it works on.
  struct Seat {
    std::optional<WorkerProcess> worker;
    bool ready = false;
    std::optional<Attempt> attempt;
    Clock::time_point since = Clock::now();  ///< of the attempt, or of the worker's start
  };

  /// Looks one job ahead, so that no worker is started for nothing.
  bool job_waits() {
    if (waiting_.empty() && !exhausted_ && !later_) {
      auto job = hooks_.next();
      exhausted_ = !job;
      later_ = job && job->line.empty();
      if (job && !later_) waiting_.push_back({std::move(*job)});
    }
    return !waiting_.empty();
  }

  /// Gives every idle worker a job or dismisses it, and starts workers while jobs wait.
  void staff() {
    later_ = false;
    for (std::size_t i = 0; i < seats_.size();) {
      auto& seat = seats_[i];
      if (seat.ready && !seat.attempt) {
        if (job_waits()) {
          assign(seat);
        } else if (!later_) {
          seats_.erase(seats_.begin() + static_cast<std::ptrdiff_t>(i));
          continue;
        }
      }
      ++i;
    }
    const auto starting = [&] {
      std::size_t count = 0;
      for (const auto& seat : seats_) count += !seat.ready;
      return count;
    };
    while (static_cast<int>(seats_.size()) < settings_.workers && job_waits() &&
           (starting() < waiting_.size() || !exhausted_))
      seats_.emplace_back().worker.emplace(settings_.command);
  }

  void assign(Seat& seat) {
    seat.attempt = std::move(waiting_.front());
    waiting_.pop_front();
    seat.since = Clock::now();
    const auto& attempt = *seat.attempt;
    if (hooks_.started)
      hooks_.started(attempt.job.id, seat.worker->process(), attempt.faults + attempt.kills + 1);
    seat.worker->send(attempt.job.line);
  }

  /// Waits for a worker to say something, to die or to run out of time.
  void wait() {
    std::vector<pollfd> polled;
    for (const auto& seat : seats_) {
      const auto write = static_cast<short>(seat.worker->wants_to_write() ? POLLOUT : 0);
      polled.push_back({seat.worker->socket(), static_cast<short>(POLLIN | write), 0});
      polled.push_back({seat.worker->message_pipe(), POLLIN, 0});
    }
    const int longest = later_ ? 0 : kTick;
    if (::poll(polled.data(), polled.size(), longest) < 0) return;  // a signal
    for (std::size_t i = 0; i < seats_.size(); ++i) {
      if (polled[2 * i + 1].revents != 0) seats_[i].worker->receive_messages();
      if ((polled[2 * i].revents & POLLOUT) != 0) seats_[i].worker->flush();
      if ((polled[2 * i].revents & ~POLLOUT) != 0) listen(seats_[i]);
      if (seats_[i].worker) check_clock(seats_[i]);
    }
    std::erase_if(seats_, [](const Seat& seat) { return !seat.worker; });
  }

  void listen(Seat& seat) {
    const bool open = seat.worker->receive();
    while (const auto line = seat.worker->take_line()) {
      if (!seat.ready) {
        seat.ready = true;
        failed_starts_ = 0;
      } else if (seat.attempt) {
        const auto id = seat.attempt->job.id;
        seat.attempt.reset();
        hooks_.done(id, *line);
      }
    }
    if (!open) lose(seat, seat.worker->finish());
  }

  void check_clock(Seat& seat) {
    if (seat.ready && !seat.attempt) return;
    const double limit = seat.ready ? settings_.time_limit : kStartLimit;
    if (seconds_since(seat.since) <= limit) return;
    (void)seat.worker->finish();
    lose(seat, {fmt::format("no answer within {:g} s", limit), false});
  }

  /// The seat's worker is gone; its job is tried again, is left, or has failed.
  void lose(Seat& seat, const WorkerEnd& end) {
    seat.worker.reset();
    if (!seat.ready && ++failed_starts_ >= kMaxFailedStarts)
      throw Error(fmt::format("workers do not start: {}", end.text));
    if (!seat.attempt) return;
    auto attempt = std::move(*seat.attempt);
    if (hooks_.retried) hooks_.retried(attempt.job.id, end.text);
    ++(end.killed ? attempt.kills : attempt.faults);
    if (attempt.faults > settings_.retries) {
      const auto count = attempt.faults == 1
                             ? "1 attempt: "
                             : fmt::format("{} attempts; the last: ", attempt.faults);
      hooks_.failed(attempt.job.id, count + end.text);
    } else if (attempt.kills <= settings_.retries) {
      waiting_.push_front(std::move(attempt));
    } else if (hooks_.left) {
      hooks_.left(attempt.job.id);
    }
  }

  const PoolSettings& settings_;
  const PoolHooks& hooks_;
  std::vector<Seat> seats_;
  std::deque<Attempt> waiting_;
  bool exhausted_ = false;
  bool later_ = false;  ///< what is next is not known yet
  int failed_starts_ = 0;
};

}  // namespace

bool run_pool(const PoolSettings& settings, const PoolHooks& hooks) {
  return Pool(settings, hooks).run();
}

}  // namespace slalom::sweep
