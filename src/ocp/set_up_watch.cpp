#include "set_up_watch.hpp"

namespace slalom::ocp {

thread_local SetUpWatch* SetUpWatch::current_ = nullptr;

SetUpWatch::SetUpWatch(const nlp::Options& options) : options_(options), outer_(current_) {
  current_ = this;
}
SetUpWatch::~SetUpWatch() {
  over();
}

void SetUpWatch::ask() const {
  if (options_.stop != nullptr && options_.stop(options_.stop_data))
    throw Stopped{nlp::Status::interrupted};
  if (timer_.wall() > options_.time_limit) throw Stopped{nlp::Status::time_limit};
}

}  // namespace slalom::ocp
