#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "slalom/sim/closed_loop.hpp"
#include "slalom/vehicle/control_signal.hpp"

namespace slalom::sim::testing {

/// An empty field: start at the origin northwards at 17 m/s, goal 1 km ahead, tyres symmetric, so
/// that driving straight on is y = 17 t to rounding.
inline Scenario open_field() {
  Scenario s;
  s.name = "open field";
  s.start = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};
  s.goal = {0, 1000, std::numbers::pi / 2, 10};
  s.vehicle.tyre_asymmetry = false;
  s.loop.timeout = 5;
  s.loop.warm_up = false;
  return s;
}

inline world::Obstacle circle(const char* name, double x, double y, double r, double vx = 0,
                              double vy = 0) {
  return {name, x, y, r, r, vx, vy};
}

/// A solved plan over `tf` seconds with `intervals` equal ones, controls given by time since the
/// plan's start.
inline planner::Plan plan_of(const planner::Request& request,
                             const std::function<vehicle::Control(double)>& control, double tf = 2,
                             int intervals = 10) {
  planner::Plan plan;
  plan.t_start = request.t_start;
  plan.tf = tf;
  for (int k = 0; k <= intervals; ++k) {
    plan.t.push_back(tf * k / intervals);
    plan.states.push_back(request.X0p);
    plan.controls.push_back(control(plan.t.back()));
  }
  plan.report.solved = true;
  plan.report.status = planner::PlanStatus::solved;
  return plan;
}

inline planner::Plan straight_on(const planner::Request& request) {
  return plan_of(request, [](double) { return vehicle::Control{0, 0}; });
}

inline planner::Plan unsolved(const planner::Request& request) {
  auto plan = straight_on(request);
  plan.report.solved = false;
  plan.report.status = planner::PlanStatus::iteration_limit;
  return plan;
}

/// Steers left and right and works the pedals, differently in every cycle, so that controls jump at
/// swaps and kink at nodes.
inline planner::Plan wavy(const planner::Request& request) {
  const double phase = 3 * request.t0;
  return plan_of(
      request,
      [phase](double t) {
        return vehicle::Control{.08 * std::cos(2.1 * t + phase), 2 * std::sin(5 * t + phase)};
      },
      2.3, 9);
}

/// What a fake planner was asked.
struct Requests {
  std::vector<planner::Request> all;
  PlanFunction answering(const PlanFunction& plan) {
    return [this, plan](const planner::Request& request) {
      all.push_back(request);
      return plan(request);
    };
  }
};

}  // namespace slalom::sim::testing
