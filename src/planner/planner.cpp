#include "slalom/planner/planner.hpp"

#include <utility>

#include "line_planner.hpp"
#include "local_frame.hpp"
#include "planning_method.hpp"
#include "receding_horizon.hpp"
#include "verified_planner.hpp"

namespace slalom::planner {

Planner::Planner(const Task& task)
    : frame_(std::make_unique<LocalFrame>(task.goal)),
      goes_on_(task.planner.method == Method::verified) {
  const Task local = frame_->to_local(task);
  if (task.planner.method == Method::verified)
    method_ = std::make_unique<VerifiedPlanner>(local);
  else if (task.planner.method == Method::along_road)
    method_ = std::make_unique<LinePlanner>(local);
  else
    method_ = std::make_unique<RecedingHorizon>(local);
}
Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

Plan Planner::plan(const Request& request) {
  const bool turn = !goes_on_ || !std::exchange(begun_, true);
  Plan plan = method_->plan(frame_->to_local(request, turn));
  frame_->to_global(plan);
  return plan;
}
void Planner::reset() {
  begun_ = false;
  method_->reset();
}
void Planner::record(const Recorder& recorder) {
  method_->record(recorder);
}

}  // namespace slalom::planner
