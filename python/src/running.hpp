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

/// Calls `work` while other Python threads run; an interrupt stops the solver by `options`, and is
/// raised then. Returns what it returned, and the seconds it took.
template <class Work>
auto run_released(nlp::Options& options, const Work& work) {
  Released released;
  options.stop = [](void* data) { return static_cast<Released*>(data)->interrupted(); };
  options.stop_data = &released;
  auto result = [&] {
    const nb::gil_scoped_release unlock;
    const Timer timer;
    auto answer = work();
    return std::pair(std::move(answer), timer.wall());
  }();
  released.raise_if_interrupted();
  return result;
}

}  // namespace slalom::python
