#include "slalom/planner/many.hpp"

#include <memory>

#include "../base/side_by_side.hpp"

namespace slalom::planner {

std::vector<Plan> plan_many(const Task& task, const std::vector<Request>& requests, int threads,
                            const std::function<bool()>& interrupted) {
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
