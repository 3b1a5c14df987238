#include "slalom/planner/many.hpp"

#include <fmt/format.h>

#include <memory>

#include "../base/side_by_side.hpp"

namespace slalom::planner {

std::vector<Plan> plan_many(const Task& task, const std::vector<Request>& requests, int threads,
                            const std::function<bool()>& interrupted) {
  for (std::size_t i = 0; i < requests.size(); ++i)
    check(requests[i], fmt::format("plan_many: request {}", i));
  std::vector<Plan> plans(requests.size());
  SideBySide pieces("plan_many", requests.size(), threads, interrupted);
  pieces.run([&]() -> SideBySide::Worker {
    auto planner = std::make_shared<Planner>(task);
    return [&, planner](std::size_t index) {
      planner->reset();
      Request request = requests[index];
      request.interrupted = [&pieces] { return pieces.ending(); };
      plans[index] = planner->plan(request);
    };
  });
  return plans;
}

}  // namespace slalom::planner
