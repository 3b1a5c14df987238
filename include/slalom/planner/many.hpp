#pragma once

#include <functional>
#include <vector>

#include "slalom/planner/plan.hpp"
#include "slalom/planner/planner.hpp"
#include "slalom/planner/task.hpp"

namespace slalom::planner {

/// Plans for many requests, in the requests' order. Each plan is the first plan of a new planner
/// for the task, so it depends only on its request. `threads` threads (0: as many as there are
/// processors) plan, each with its own planner.
///
/// `interrupted`, if given, is polled on the calling thread instead of the requests' own functions.
/// Once it is true, running solves end, and the other requests return at once, not solved. Throws
/// InvalidValue as Planner does, and for a negative `threads`.
[[nodiscard]] std::vector<Plan> plan_many(const Task& task, const std::vector<Request>& requests,
                                          int threads = 0,
                                          const std::function<bool()>& interrupted = {});

}  // namespace slalom::planner
