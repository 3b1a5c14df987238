#include "plans.hpp"

#include <algorithm>
#include <utility>

namespace slalom::ocp {

Plan::Plan(const Problem& problem, Solution solved, double swap)
    : t_swap(swap), solution(std::move(solved)) {
  between = std::make_shared<const Interpolant>(problem, solution.trajectory, solution.mesh,
                                                solution.scheme);
}

Trajectory Plan::shifted(double t0, double tf) const {
  Trajectory guess = solution.trajectory;
  guess.t0 = t0;
  guess.tf = tf;
  for (std::size_t point = 0; point < guess.tau.size(); ++point) {
    guess.states[point] = between->states(guess.time(point));
    guess.controls[point] = between->controls(guess.time(point));
  }
  return guess;
}

Duals Plan::shifted_duals(double t0, double tf) const {
  Duals duals{solution.trajectory.tau, solution.collocated_costates, solution.multipliers};
  const auto shift = [&](std::vector<double>& taus) {
    for (double& tau : taus) tau = (solution.trajectory.time_at(tau) - t0) / (tf - t0);
  };
  shift(duals.tau);
  shift(duals.costates.tau);
  return duals;
}

void Plans::follow(Plan plan) {
  next_ = std::make_unique<Plan>(std::move(plan));
}

const Plan* Plans::at(double t) const {
  return next_ && t >= next_->t_swap ? next_.get() : current_.get();
}

void Plans::pass(double t) {
  if (next_ && t >= next_->t_swap) current_ = std::move(next_);
}

std::vector<double> Plans::corners() const {
  std::vector<double> times;
  for (const auto* plan : {current_.get(), next_.get()}) {
    if (plan == nullptr) continue;
    times.push_back(plan->t_swap);
    for (const double tau : plan->solution.mesh.breakpoints())
      times.push_back(plan->solution.trajectory.time_at(tau));
  }
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace slalom::ocp
