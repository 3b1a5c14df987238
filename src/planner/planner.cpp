#include "slalom/planner/planner.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "line_planner.hpp"
#include "local_frame.hpp"
#include "planning_method.hpp"
#include "receding_horizon.hpp"
#include "slalom/base/error.hpp"
#include "solving.hpp"
#include "verified_planner.hpp"

namespace slalom::planner {
namespace {

/// Of a place [m] and a heading [rad], and of what else is a vehicle's state [its unit].
constexpr double kFarthest = 1e9, kFastest = 1e3;
/// Of one cycle [s].
constexpr double kLongestHorizon = 3600, kShortestHorizon = 1e-3;

}  // namespace

void check(const Request& request, const std::string& where) {
  const auto expect = [&](bool good, const char* what, double found, const char* expected) {
    if (!good) throw InvalidValue(where + ": " + what, fmt::format("{}", found), expected);
  };
  for (std::size_t i = 0; i < request.X0p.size(); ++i) {
    const bool place = i == vehicle::X || i == vehicle::Y || i == vehicle::PSI;
    const double most = place ? kFarthest : kFastest;
    if (!(std::fabs(request.X0p[i]) <= most))
      throw InvalidValue(where + ": state",
                         fmt::format("{} = {}", vehicle::kStateNames[i], request.X0p[i]),
                         fmt::format("a number of at most {:g}, of either sign", most));
  }
  expect(std::fabs(request.t0) <= kLatest, "t0", request.t0, "a time within 1e10 s of 0");
  const double ahead = request.t_start - request.t0;
  expect(ahead >= 0 && ahead <= kLongestHorizon, "t_start - t0", ahead,
         "an execution horizon (tex) of 0 to 3600 s");
  expect(request.tex == 0 || (request.tex >= kShortestHorizon && request.tex <= kLongestHorizon),
         "tex", request.tex, "0, or .001 to 3600 s");
  expect(request.time_limit >= 0, "time_limit", request.time_limit, "a number >= 0");
  expect(request.clock_limit >= 0, "clock_limit", request.clock_limit, "a number >= 0");
  expect(std::isfinite(request.best_iterate_tol), "best_iterate_tol", request.best_iterate_tol,
         "a finite number; negative for never");
}

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
  check(request, "plan");
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
