#pragma once

#include <functional>
#include <vector>

#include "slalom/planner/plan.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/planner/task.hpp"

namespace slalom::planner {

/// Plans for many requests, each as a planner does that has just been made for the task, so that a
/// plan depends on its request alone. In `threads` threads (0: as many as there are processors),
/// each with a planner of its own. Plans are in the requests' order.
///
/// `interrupted`, if given, is polled on the calling thread in place of what the requests have;
/// once true, what is under way ends, and so does the rest at once, not solved. Throws InvalidValue
/// as Planner does, and for a negative `threads`.
[[nodiscard]] std::vector<Plan> plan_many(const Task& task, const std::vector<Request>& requests,
                                          int threads = 0,
                                          const std::function<bool()>& interrupted = {});

}  // namespace slalom::planner
