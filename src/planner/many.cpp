#include "slalom/planner/many.hpp"

#include <memory>
#include <string>

#include "../base/side_by_side.hpp"
#include "slalom/base/error.hpp"

namespace slalom::planner {

std::vector<Plan> plan_many(const Task& task, const std::vector<Request>& requests, int threads,
                            const std::function<bool()>& interrupted) {
  if (threads < 0)
    throw InvalidValue("plan_many: threads", std::to_string(threads),
                       "a number of threads, or 0 for as many as there are processors");
  std::vector<Plan> plans(requests.size());
  SideBySide pieces(requests.size(), threads, interrupted);
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
