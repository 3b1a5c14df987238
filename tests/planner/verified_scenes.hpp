#pragma once

#include <numbers>

#include "slalom/planner/planner.hpp"
#include "slalom/vehicle/plant.hpp"

namespace slalom::planner {

/// Northwards at 17 m/s, the goal 180 m ahead, an obstacle in the way.
inline Task verified_task() {
  Task task;
  task.planner.method = Method::verified;
  task.planner.arrival_N = 20;
  task.planner.search_places = 5000;
  task.goal = {0, 180, std::numbers::pi / 2, 15};
  task.obstacles = {{"O1", 1, 80, 4, 4, 0, 0}};
  return task;
}

/// The same with a wall across the whole road in the way, at y.
inline Task before_a_wall(double y) {
  Task walled = verified_task();
  walled.region.x_min = -40;
  walled.region.x_max = 40;
  walled.obstacles = {{"wall", 0, y, 80, 2, 0, 0}};
  return walled;
}

inline Request northwards() {
  Request request;
  request.X0p = {0, 0, 0, 0, std::numbers::pi / 2, 0, 17, 0};
  return request;
}

/// The request of the next cycle: what the plant makes of the plan in .5 s.
inline Request next(const Task& task, const Request& last, const Plan& plan) {
  Request request = last;
  request.t0 += 0.5;
  request.t_start += 0.5;
  request.X0p = vehicle::Plant(task.vehicle, 1e-9, 0.02)
                    .predict(last.X0p, control_signal(plan), last.t_start, request.t_start);
  return request;
}

}  // namespace slalom::planner
