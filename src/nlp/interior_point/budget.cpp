#include "budget.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::nlp::ipm {

void Budget::begin(const Options& options, const Timer& timer) {
  options_ = &options;
  timer_ = timer;
  callback_s_ = longest_step_s_ = last_iteration_s_ = 0;
}

std::optional<Status> Budget::spent(int iterations) {
  const double used = used_s();
  if (iterations > 0) longest_step_s_ = std::max(longest_step_s_, used - last_iteration_s_);
  last_iteration_s_ = used;
  if (iterations >= options_->max_iterations) return Status::iteration_limit;
  if (used + longest_step_s_ > options_->time_limit) return Status::time_limit;
  if (asked_to_stop()) return Status::interrupted;
  return std::nullopt;
}

bool Budget::passed() {
  return std::isfinite(options_->time_limit) && used_s() > options_->time_limit;
}

bool Budget::asked_to_stop() {
  if (options_->stop == nullptr) return false;
  bool stop = false;
  call([&] { stop = options_->stop(options_->stop_data); });
  return stop;
}

void Budget::report(Answer& answer) const {
  answer.cpu_s = timer_.cpu();
  answer.wall_s = timer_.wall();
  answer.callback_s = callback_s_;
  answer.longest_step_s = longest_step_s_;
}

}  // namespace slalom::nlp::ipm
