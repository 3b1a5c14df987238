#include "local_frame.hpp"

#include <cmath>
#include <memory>
#include <numbers>

namespace slalom::planner {

using vehicle::PSI;
using vehicle::X;
using vehicle::Y;

LocalFrame::LocalFrame(const world::Goal& goal)
    : x_(kGrid * std::round(goal.x / kGrid)), y_(kGrid * std::round(goal.y / kGrid)) {}

double LocalFrame::without_turns(double psi) {
  return std::fabs(psi) <= std::numbers::pi ? psi : std::remainder(psi, 2 * std::numbers::pi);
}

void LocalFrame::move(std::vector<world::Obstacle>& obstacles) const {
  if (x_ == 0 && y_ == 0) return;
  for (auto& o : obstacles) {
    o.x -= x_;
    o.y -= y_;
    if (o.trajectory)
      o.trajectory = std::make_shared<world::MovedTrajectory>(o.trajectory, world::Point{-x_, -y_});
  }
}

Task LocalFrame::to_local(Task task) const {
  task.goal.x -= x_;
  task.goal.y -= y_;
  task.goal.psi = without_turns(task.goal.psi);
  task.region.x_min -= x_;
  task.region.x_max -= x_;
  task.region.y_min -= y_;
  task.region.y_max -= y_;
  move(task.obstacles);
  if (task.road && (x_ != 0 || y_ != 0)) task.road = task.road->moved({-x_, -y_});
  return task;
}

Request LocalFrame::to_local(Request request, bool turn) {
  request.X0p[X] -= x_;
  request.X0p[Y] -= y_;
  if (turn) turned_ = request.X0p[PSI] - without_turns(request.X0p[PSI]);
  request.X0p[PSI] -= turned_;
  if (request.obstacles) move(*request.obstacles);
  return request;
}

void LocalFrame::to_global(Plan& plan) const {
  for (auto& state : plan.states) {
    state[X] += x_;
    state[Y] += y_;
    state[PSI] += turned_;
  }
  for (auto& candidate : plan.candidates)
    for (auto& point : candidate.path) {
      point.x += x_;
      point.y += y_;
    }
}

}  // namespace slalom::planner
