#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slalom::report {
namespace {
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
}

std::string outcome_words(const sim::Drive& drive) {
  switch (drive.outcome) {
    case sim::Outcome::goal:
      return "Reached the goal";
    case sim::Outcome::crash:
      return drive.hit.empty() ? "Crashed" : fmt::format("Crashed into {}", drive.hit);
    case sim::Outcome::wheel_lift:
      return drive.hit.empty() ? "A wheel lifted" : fmt::format("Wheel {} lifted", drive.hit);
    case sim::Outcome::off_road:
      return "Left the road";
    case sim::Outcome::not_optimal:
      return "The planner found no plan";
    case sim::Outcome::solve_time:
      return "Planning took too long";
    case sim::Outcome::timeout:
      return "Did not arrive in time";
    case sim::Outcome::interrupted:
      return "Interrupted";
  }
  return "Ended";
}

double mean_speed(const sim::Drive& drive) {
  const auto& plant = drive.plant;
  if (plant.empty()) return kNaN;
  double integral = 0;
  for (std::size_t i = 1; i < plant.size(); ++i)
    integral += (plant[i].t - plant[i - 1].t) *
                (plant[i].state[vehicle::UX] + plant[i - 1].state[vehicle::UX]) / 2;
  const double duration = plant.back().t - plant.front().t;
  return duration > 0 ? integral / duration : plant.front().state[vehicle::UX];
}

vehicle::State state_at(const sim::Drive& drive, double t) {
  const auto& plant = drive.plant;
  const auto after = std::upper_bound(plant.begin(), plant.end(), t,
                                      [](double time, const auto& s) { return time < s.t; });
  if (after == plant.begin()) return plant.front().state;
  if (after == plant.end()) return plant.back().state;
  const auto& a = *(after - 1);
  const auto& b = *after;
  const double w = b.t > a.t ? (t - a.t) / (b.t - a.t) : 0;
  vehicle::State state;
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] = a.state[i] + w * (b.state[i] - a.state[i]);
  return state;
}

}  // namespace slalom::report
