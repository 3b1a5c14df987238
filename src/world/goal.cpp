#include "slalom/world/goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "slalom/base/error.hpp"

namespace slalom::world {
namespace {

using vehicle::State;

/// How far a place is outside the goal's [m].
double outside_place(const Goal& goal, const State& state) {
  const double dx = state[vehicle::X] - goal.x, dy = state[vehicle::Y] - goal.y;
  if (goal.kind() == GoalKind::square) return std::max(std::abs(dx), std::abs(dy)) - goal.sigma;
  const double c = std::cos(goal.psi), s = std::sin(goal.psi);
  return std::max(std::abs(c * dx + s * dy) - goal.length / 2,
                  std::abs(c * dy - s * dx) - goal.width / 2);
}

/// How far a place is before a line across the road [m].
double before_line(const Goal& goal, const State& state, const Road& road) {
  const double ahead = goal.s - road.project({state[vehicle::X], state[vehicle::Y]}).s;
  return road.closed() ? std::remainder(ahead, road.length()) : ahead;
}

}  // namespace

double Goal::outside(const State& state, double t, const Road* road) const {
  double most = -kAbsent;
  switch (kind()) {
    case GoalKind::square:
    case GoalKind::rectangle:
      most = outside_place(*this, state);
      break;
    case GoalKind::line:
      most = before_line(*this, state, *road);
      break;
    case GoalKind::time:
      most = time - t;
      break;
    case GoalKind::laps:
      return kAbsent;
  }
  if (psi_tolerance < kAbsent)
    most =
        std::max(most, std::fabs(std::remainder(state[vehicle::PSI] - psi, 2 * std::numbers::pi)) -
                           psi_tolerance);
  if (ux_min > -kAbsent) most = std::max(most, ux_min - state[vehicle::UX]);
  if (ux_max < kAbsent) most = std::max(most, state[vehicle::UX] - ux_max);
  if (t_min > -kAbsent) most = std::max(most, t_min - t);
  if (t_max < kAbsent) most = std::max(most, t - t_max);
  return most;
}

Goal placed(Goal goal, const Road* road) {
  if (goal.is_place() || road == nullptr) return goal;
  const RoadPlace at = road->at(goal.kind() == GoalKind::line ? goal.s : road->length());
  goal.x = at.x;
  goal.y = at.y;
  goal.psi = at.psi;
  return goal;
}

double by_the_lap(const Goal& goal, const Road& road, double ahead) {
  if (!road.closed()) return ahead;
  const double lap = road.length();
  const double behind = goal.kind() == GoalKind::line ? lap / 2 : goal.half_length();
  return ahead - lap * std::floor((ahead + behind) / lap);
}

void check(const Goal& goal, const Road* road, const std::string& where) {
  const Goal absent;
  std::set<std::string> given;
  for (const auto& entry : goal_options().entries()) {
    const OptionValue value = entry.get(goal);
    if (value == entry.get(absent)) continue;
    (void)entry.info.checked(value, where);
    given.insert(entry.info.name);
  }
  const auto refuse = [&](const std::string& found, const std::string& expected,
                          std::vector<std::string> keys) {
    throw InvalidValue(where, found, expected, std::move(keys));
  };
  if (!goal.is_place() && road == nullptr)
    refuse("a goal of the road without a road", "a section `road`", {"s", "time", "laps"});
  if (goal.kind() == GoalKind::line && !(goal.s > 0 && goal.s <= road->length()))
    refuse(fmt::format("s = {:.6g} m", goal.s),
           fmt::format("a line on the road, above 0 and at most {:.6g} m along it", road->length()),
           {"s"});
  if (goal.kind() == GoalKind::laps && !(road->closed() && std::floor(goal.laps) == goal.laps))
    refuse(fmt::format("laps = {:.6g}", goal.laps), "a whole number of laps of a closed road",
           {"laps"});
  std::vector<std::string> kinds;
  for (const char* key : {"s", "time", "laps", "length"})
    if (given.contains(key)) kinds.emplace_back(key);
  if (kinds.size() > 1)
    refuse(fmt::format("both {} and {}", kinds[0], kinds[1]),
           "one of s, time, laps, and length and width", kinds);
  for (const char* key : {"psi_tolerance", "ux_min", "ux_max", "t_min", "t_max"})
    if (goal.kind() == GoalKind::laps && given.contains(key))
      refuse(fmt::format("{} beside laps", key), "laps alone, or a line s with conditions", {key});
  if (goal.kind() == GoalKind::time && given.contains("psi_tolerance"))
    refuse("psi_tolerance beside time", "no direction where it is not known where the drive ends",
           {"psi_tolerance"});
  if (goal.kind() == GoalKind::time && !(goal.t_min <= goal.time && goal.time <= goal.t_max))
    refuse(fmt::format("time = {:.6g}, t_min = {:.6g}, t_max = {:.6g}", goal.time, goal.t_min,
                       goal.t_max),
           "a time from t_min to t_max", {"time", "t_min", "t_max"});
  if (std::isinf(goal.length) != std::isinf(goal.width))
    refuse("one of length and width", "both of a rectangle", {"length", "width"});
  if (goal.ux_min > goal.ux_max)
    refuse(fmt::format("ux_min = {:.6g}, ux_max = {:.6g}", goal.ux_min, goal.ux_max),
           "ux_min <= ux_max", {"ux_min", "ux_max"});
  if (goal.t_min > goal.t_max)
    refuse(fmt::format("t_min = {:.6g}, t_max = {:.6g}", goal.t_min, goal.t_max), "t_min <= t_max",
           {"t_min", "t_max"});
}

const OptionTable<Goal>& goal_options() {
  static const auto table = [] {
    const auto any = OptionRange::any(), positive = OptionRange::positive();
    const auto least = OptionRange::non_negative();
    OptionTable<Goal> t;
    t.real("x", &Goal::x, any, "m", "East position of the goal.")
        .real("y", &Goal::y, any, "m", "North position of the goal.")
        .real("psi", &Goal::psi, any, "rad", "Direction of the line through the goal to keep to.")
        .real("sigma", &Goal::sigma, positive, "m",
              "Half-width of the square around the goal; within it the vehicle has arrived.")
        .real("length", &Goal::length, positive, "m",
              "Of a rectangle about (x, y) instead of the square, along psi.")
        .real("width", &Goal::width, positive, "m", "Of that rectangle, across psi.")
        .real("s", &Goal::s, positive, "m",
              "A line across the road instead of a place, so far along the road's line.")
        .real("time", &Goal::time, positive, "s",
              "As far along the road as possible by this time, instead of a place.")
        .real("laps", &Goal::laps, positive, "1", "So many laps of a closed road.")
        .real("psi_tolerance", &Goal::psi_tolerance, least, "rad",
              "By which the heading may differ from psi on arrival.")
        .real("ux_min", &Goal::ux_min, any, "m/s", "Speed on arrival, at least.")
        .real("ux_max", &Goal::ux_max, any, "m/s", "Speed on arrival, at most.")
        .real("t_min", &Goal::t_min, any, "s", "Arrival counts from this time on.")
        .real("t_max", &Goal::t_max, any, "s", "And until this.");
    return t;
  }();
  return table;
}

}  // namespace slalom::world
