#include "timing.hpp"

#include <algorithm>
#include <limits>

namespace slalom::sim {
namespace {

/// The deadline came before the plan.
void cut_off(Cycle& cycle, double deadline) {
  cycle.charged = cycle.solve_time = deadline;
  auto& report = cycle.plan.report;
  report.solved = report.best_iterate = false;
  report.status = planner::PlanStatus::time_limit;
}

}  // namespace

Timing::Timing(const LoopSettings& settings, planner::Method method)
    : settings_(settings),
      latency_(settings),
      deadline_(settings.deadline == Deadline::tex ||
                (settings.deadline == Deadline::by_planner && !latency_.scripted() &&
                 method == planner::Method::verified)),
      verifies_(method == planner::Method::verified) {}

double Timing::time_limit() const {
  return deadline_ && !latency_.scripted() ? std::min(settings_.tex, settings_.solve_time_limit)
                                           : settings_.solve_time_limit;
}

double Timing::clock_limit() const {
  return deadline_ && settings_.latency == LatencyRule::measured
             ? settings_.tex
             : std::numeric_limits<double>::infinity();
}

void Timing::settle(Cycle& cycle) {
  cycle.charged = latency_.charge(cycle.index, cycle.solve_time);
  if (latency_.scripted()) {
    cycle.solve_time = cycle.charged;
    if (deadline_ && cycle.charged > settings_.tex) {
      cut_off(cycle, settings_.tex);
      cycle.late = verifies_;
    }
  }
  ++horizons_;
  const double ready = cycle.t0 + cycle.charged;
  if (ready > next_cycle()) {
    cycle.late = verifies_;
    grid_ = ready;
    horizons_ = 0;
  }
  cycle.t_swap = plant_waits() ? cycle.t0 : next_cycle();
}

}  // namespace slalom::sim
