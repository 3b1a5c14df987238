#pragma once

#include <utility>

#include "binding.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::python {

/// The options that an answer keeps shall not point to what has gone.
inline void forget_stop(nlp::Options& options) {
  options.stop = nullptr;
  options.stop_data = nullptr;
}

/// What ends a solve from outside: Ctrl-C, or the clock, which counts from the call's start on.
class Ending {
 public:
  explicit Ending(nlp::Options& options) : limit_(options.time_limit) {
    options.stop = [](void* data) { return static_cast<Ending*>(data)->asked(); };
    options.stop_data = this;
  }

  double seconds() const { return timer_.wall(); }
  void raise_if_interrupted() const { released_.raise_if_interrupted(); }
  /// The solver says `interrupted` of both.
  void tell(nlp::Status& status) const {
    if (late_ && status == nlp::Status::interrupted) status = nlp::Status::time_limit;
  }

 private:
  bool asked() {
    late_ = late_ || timer_.wall() > limit_;
    return late_ || released_.interrupted();
  }

  Released released_;
  const Timer timer_;
  const double limit_;  ///< [s]
  bool late_ = false;
};

/// Tells what ended it to an answer and its parts, or to each of several.
template <class Answer>
void tell(const Ending& ending, Answer& answer) {
  if constexpr (requires { answer.begin(); }) {
    for (auto& each : answer) tell(ending, each);
  } else if constexpr (requires { answer.solution; }) {
    tell(ending, answer.solution);
    for (auto& mesh : answer.meshes) ending.tell(mesh.status);
  } else {
    ending.tell(answer.status);
    if constexpr (requires { answer.phases; })
      for (auto& phase : answer.phases) ending.tell(phase.status);
  }
}

/// Calls `work` while other Python threads run; an interrupt stops the solver by `options`, and is
/// raised then; so does `options.time_limit`, counted from now on, by the clock. Returns what it
/// returned, and the seconds it took.
template <class Work>
auto run_released(nlp::Options& options, const Work& work) {
  Ending ending(options);
  auto result = [&] {
    const nb::gil_scoped_release unlock;
    auto answer = work();
    tell(ending, answer);
    return std::pair(std::move(answer), ending.seconds());
  }();
  ending.raise_if_interrupted();
  return result;
}

}  // namespace slalom::python
