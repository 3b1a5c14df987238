#include "slalom/sim/scenario.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/sim/latency.hpp"
#include "slalom/vehicle/model.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::sim {
namespace {

using Keys = std::vector<std::string>;

constexpr double kCrawl = 0.1;  // [m/s]

void check_region(const world::Region& region, const std::string& where) {
  const auto side = [&](double lo, double hi, const std::string& axis) {
    if (!(lo < hi))
      throw InvalidValue(where, fmt::format("{0}_min = {1}, {0}_max = {2}", axis, lo, hi),
                         fmt::format("{0}_min < {0}_max", axis), {axis + "_min", axis + "_max"});
  };
  side(region.x_min, region.x_max, "x");
  side(region.y_min, region.y_max, "y");
}

/// A polygon says an obstacle's size, and a trajectory where it is: what is set beside them would
/// say nothing.
void check_obstacle(const world::Obstacle& obstacle, const std::string& where) {
  world::obstacle_options().check(obstacle, where);
  const auto refuse = [&](bool applies, const char* key, double value, double silent,
                          const char* told_by) {
    if (applies && value != silent)
      throw InvalidValue(where, fmt::format("{} = {:.9g}", key, value),
                         fmt::format("none, for {} says it", told_by), {key});
  };
  const double reach = obstacle.outline ? obstacle.outline->reach() : 0;
  for (const auto& [key, value] : {std::pair{"a", obstacle.a}, {"b", obstacle.b}})
    refuse(obstacle.outline != nullptr, key, value, reach, "the polygon");
  for (const auto& [key, value] : {std::pair{"x", obstacle.x},
                                   {"y", obstacle.y},
                                   {"vx", obstacle.vx},
                                   {"vy", obstacle.vy},
                                   {"psi", obstacle.psi}})
    refuse(obstacle.trajectory != nullptr, key, value, 0, "the table or path");
}

/// What each part of a scenario says of its own values.
void check_parts(const Scenario& s, const std::string& where) {
  check_within("planner", [&] { planner::check(s.planner, where); });
  check_within("vehicle", [&] { vehicle::check(s.vehicle, where); });
  check_within("loop", [&] { loop_options().check(s.loop, where); });
  check_within("loop", [&] { (void)Latency(s.loop); });
  const auto check_options = [&](const std::string& section, const auto& table, const auto& part) {
    check_within(section, [&] { table.check(part, where + ": " + section); });
  };
  check_options("plant", plant_options(), s.plant);
  check_options("sensing", sensing_options(), s.sensing);
  check_options("start", vehicle::state_options(), s.start);
  check_within("goal", [&] { world::check(s.goal, s.road.get(), where + ": goal"); });
  check_within("region", [&] { check_region(s.region, where + ": region"); });
  for (const auto& obstacle : s.obstacles)
    check_within("obstacles." + obstacle.name, [&] {
      check_obstacle(obstacle, fmt::format("{}: obstacle {}", where, obstacle.name));
    });
}

/// Throws InvalidValue unless a start's value lies in [lo, hi]; `low` and `high` are keys beside
/// its own that may be at fault at either end.
void require_within(const Scenario& s, vehicle::StateIndex index, double lo, double hi,
                    const Keys& low, const Keys& high, const std::string& where,
                    const std::string& reason) {
  const double value = s.start[index];
  // A heading is the same but for whole turns.
  const double bounded =
      index == vehicle::PSI ? std::remainder(value, 2 * std::numbers::pi) : value;
  if (bounded >= lo && bounded <= hi) return;
  const std::string name = vehicle::kStateNames[index];
  Keys keys = {"start." + name};
  const auto& others = bounded < lo ? low : high;
  keys.insert(keys.end(), others.begin(), others.end());
  throw InvalidValue(where + ": start", fmt::format("{} = {:.9g}", name, value),
                     fmt::format("{:.9g} to {:.9g} ({})", lo, hi, reason), keys);
}

void check_start_bounds(const Scenario& s, const vehicle::Parameters& driven,
                        const std::string& where) {
  using namespace vehicle;
  const Parameters& car = s.vehicle;
  const auto require = [&](StateIndex index, double lo, double hi, const Keys& low,
                           const Keys& high, const std::string& reason) {
    require_within(s, index, lo, hi, low, high, where, reason);
  };
  require(X, s.region.x_min, s.region.x_max, {"region.x_min"}, {"region.x_max"}, "the region");
  require(Y, s.region.y_min, s.region.y_max, {"region.y_min"}, {"region.y_max"}, "the region");
  const world::Footprint footprint(car);
  if (const double out = footprint.outside(s.region, s.start); !footprint.is_point() && out > 0)
    throw InvalidValue(where + ": start",
                       fmt::format("({:.6g}, {:.6g}), its footprint {:.6g} m outside the region",
                                   s.start[X], s.start[Y], out),
                       "a footprint within the region", {"start", "region", "vehicle.footprint"});
  const Keys psi = {"vehicle.psi_max"}, sa = {"vehicle.sa_max_deg"};
  require(PSI, -car.psi_max, car.psi_max, psi, psi, "psi_max, in rad, but for whole turns");
  require(SA, -car.sa_max(), car.sa_max(), sa, sa, "sa_max_deg, in rad");
  // A vehicle that may crawl may also stand.
  require(UX, car.ux_min <= kCrawl ? 0 : car.ux_min, car.ux_max, {"vehicle.ux_min"},
          {"vehicle.ux_max"}, "0 or ux_min to ux_max, in m/s");
  require(AX, car.ax_min_at(s.start[UX]), car.ax_max_at(s.start[UX]),
          {"start.ux", "vehicle.ax_min"}, {"start.ux", "vehicle.ax_max"},
          "ax_min to ax_max at the start's ux, in m/s^2");
  const WheelLoads loads = Dynamics(driven).wheel_loads(s.start);
  for (std::size_t i = 0; i < kWheels; ++i)
    if (!(loads[i] >= s.loop.Fz_failure))
      throw InvalidValue(where + ": start", fmt::format("{} = {:.6g} N", kWheelNames[i], loads[i]),
                         fmt::format("at least Fz_failure = {:.6g} N", s.loop.Fz_failure),
                         {"start", "loop.Fz_failure", "plant.cg_shift", "plant.mass_factor"});
}

/// A model that holds the speed begins with one.
void check_held_speed(const Scenario& s, const std::string& where) {
  if (s.planner.model != vehicle::ModelKind::constant_speed) return;
  const auto refuse = [&](vehicle::StateIndex index, const char* expected) {
    const std::string name = vehicle::kStateNames[index];
    throw InvalidValue(
        where + ": start", fmt::format("{} = {:.9g}", name, s.start[index]),
        fmt::format("{}, for planner model constant_speed holds the speed", expected),
        {"start." + name, "planner.model"});
  };
  if (s.start[vehicle::AX] != 0) refuse(vehicle::AX, "0");
  if (s.start[vehicle::UX] == 0) refuse(vehicle::UX, "more than 0");
}

void check_start_clear(const Scenario& s, const std::string& where) {
  const world::Footprint footprint(s.vehicle);
  for (const auto& obstacle : s.obstacles) {
    if (!obstacle.present(0, 0)) continue;
    const double clearance = footprint.distance(obstacle.grown(s.loop.sm_crash), s.start, 0);
    if (!(clearance >= 0))
      throw InvalidValue(
          where + ": start",
          fmt::format(
              "({:.6g}, {:.6g}), {}{:.6g} m inside obstacle {} grown by sm_crash = {:.6g} m",
              s.start[vehicle::X], s.start[vehicle::Y],
              footprint.is_point() ? "" : "its footprint ", -clearance, obstacle.name,
              s.loop.sm_crash),
          "a start outside every grown obstacle",
          {"start", "obstacles." + obstacle.name, "loop.sm_crash"});
  }
}

/// A line across the road lies ahead of the start.
void check_line(const Scenario& s, const std::string& where) {
  if (s.goal.kind() != world::GoalKind::line) return;
  world::Goal line;
  line.s = s.goal.s;
  if (!line.reached(s.start, 0, s.road.get())) return;
  const double start = s.road->project({s.start[vehicle::X], s.start[vehicle::Y]}).s;
  throw InvalidValue(
      where + ": goal",
      fmt::format("a line at s = {:.6g} m, and a start at {:.6g} m", s.goal.s, start),
      s.road->closed() ? "a line less than half a lap ahead of the start, or laps"
                       : "a line ahead of the start",
      {"goal.s", "start"});
}

/// A place on an open road that a plan along it comes to lies ahead of the start.
void check_ahead(const Scenario& s, const std::string& where) {
  if (s.road->closed() || !s.goal.is_place() || s.arrived(s.start, 0) ||
      s.planner.method == planner::Method::verified)
    return;
  const double start = s.road->project({s.start[vehicle::X], s.start[vehicle::Y]}).s;
  const double goal = s.road->project({s.goal.x, s.goal.y}).s;
  if (goal < start)
    throw InvalidValue(
        where + ": goal",
        fmt::format("({:.6g}, {:.6g}), {:.6g} m behind the start along the road", s.goal.x,
                    s.goal.y, start - goal),
        fmt::format("a goal ahead of the start, for planner {} drives along the road",
                    s.planner.name),
        {"goal", "start", "road"});
}

/// The road is wide enough for the vehicle, and start and goal are on it.
void check_road(const Scenario& s, const std::string& where) {
  if (s.planner.method == planner::Method::along_road) {
    if (!s.road)
      throw InvalidValue(where, fmt::format("planner {} without a road", s.planner.name),
                         "a section `road`", {"planner"});
    if (!s.obstacles.empty())
      throw InvalidValue(where, fmt::format("planner {} among obstacles", s.planner.name),
                         "no obstacles, of which it knows nothing, or P_E_road", {"planner"});
  }
  if (!s.road) return;
  const world::Footprint footprint(s.vehicle);
  const double needed = footprint.is_point() ? 0 : s.vehicle.width;
  if (s.road->narrowest() <= needed)
    throw InvalidValue(where + ": road", fmt::format("a width of {:.6g} m", s.road->narrowest()),
                       fmt::format("more than the vehicle's width of {:.6g} m", needed),
                       {"road", "vehicle.width"});
  if (const double off = -footprint.edge_distance(*s.road, s.start); off > 0)
    throw InvalidValue(
        where + ": start",
        fmt::format("({:.6g}, {:.6g}), {}{:.6g} m off the road", s.start[vehicle::X],
                    s.start[vehicle::Y], footprint.is_point() ? "" : "its footprint ", off),
        "a start on the road", {"start", "road"});
  if (s.goal.is_place() && s.road->edge_distance(world::Point{s.goal.x, s.goal.y}) < 0)
    throw InvalidValue(where + ": goal",
                       fmt::format("({:.6g}, {:.6g}), {:.6g} m off the road", s.goal.x, s.goal.y,
                                   -s.road->edge_distance(world::Point{s.goal.x, s.goal.y})),
                       "a goal on the road", {"goal", "road"});
  if (s.goal.kind() == world::GoalKind::laps && s.planner.method == planner::Method::verified)
    throw InvalidValue(where + ": goal",
                       fmt::format("laps = {:.6g} by planner {}", s.goal.laps, s.planner.name),
                       "planner P_L, or another of the methods along_road and receding_horizon",
                       {"goal.laps", "planner"});
  check_line(s, where);
  check_ahead(s, where);
}

/// Whether an obstacle covers the goal's place: all corners of it.
bool covers(const world::Obstacle& obstacle, const world::Goal& goal) {
  const bool square = goal.kind() == world::GoalKind::square;
  const double along = square ? goal.sigma : goal.length / 2;
  const double across = square ? goal.sigma : goal.width / 2;
  const double c = square ? 1 : std::cos(goal.psi), s = square ? 0 : std::sin(goal.psi);
  for (const double u : {-along, along})
    for (const double w : {-across, across})
      if (world::distance(obstacle, goal.x + c * u - s * w, goal.y + s * u + c * w, 0) >= 0)
        return false;
  return true;
}

/// A plan ends at the goal, within the region and off every obstacle that stands; what is verified
/// ends anywhere in the goal's place.
void check_goal(const Scenario& s, const std::string& where) {
  if (!s.goal.is_place()) return;
  if (!s.region.contains(s.goal.x, s.goal.y))
    throw InvalidValue(where + ": goal", fmt::format("({:.6g}, {:.6g})", s.goal.x, s.goal.y),
                       "a goal within the region", {"goal", "region"});
  const bool verifies = s.planner.method == planner::Method::verified;
  const double margin = verifies ? s.planner.verified_clearance : s.planner.sm_end;
  for (const auto& obstacle : s.obstacles) {
    if (obstacle.moves()) continue;
    const double grown = margin + obstacle.margin_start;
    const world::Obstacle kept_off = obstacle.grown(grown);
    const double clearance = world::distance(kept_off, s.goal.x, s.goal.y, 0);
    if (!(clearance >= 0) && (!verifies || covers(kept_off, s.goal)))
      throw InvalidValue(
          where + ": goal",
          fmt::format("({:.6g}, {:.6g}), {:.6g} m inside obstacle {} grown by {} = {:.6g} m{}",
                      s.goal.x, s.goal.y, -clearance, obstacle.name,
                      verifies ? "verified_clearance" : "sm_end", margin,
                      obstacle.margin_start > 0
                          ? fmt::format(" and margin_start = {:.6g} m", obstacle.margin_start)
                          : ""),
          "a goal outside every grown obstacle that stands",
          {"goal", "obstacles." + obstacle.name,
           verifies ? "planner.verified_clearance" : "planner.sm_end"});
  }
}

/// What is verified keeps all by which a drive fails.
void check_verified(const Scenario& s, const std::string& where) {
  if (s.planner.method != planner::Method::verified) return;
  const auto require = [&](double kept, const char* key, double least, const char* failure) {
    if (kept >= least) return;
    throw InvalidValue(where + ": planner", fmt::format("{} = {:.6g}", key, kept),
                       fmt::format("at least {} = {:.6g}, at which a drive fails", failure, least),
                       {std::string("planner.") + key, std::string("loop.") + failure});
  };
  require(s.planner.kept_clearance, "kept_clearance", s.loop.sm_crash, "sm_crash");
  require(s.planner.kept_wheel_load, "kept_wheel_load", s.loop.Fz_failure, "Fz_failure");
  require(s.planner.verified_wheel_load, "verified_wheel_load", s.loop.Fz_failure, "Fz_failure");
  if (s.loop.sm_crash > 0 && !world::Footprint(s.vehicle).is_point())
    throw InvalidValue(where + ": loop", fmt::format("sm_crash = {:.6g}", s.loop.sm_crash),
                       "0, for the plan of a body that begins too near to an obstacle is verified "
                       "if it does not touch it",
                       {"loop.sm_crash", "vehicle.footprint"});
}

}  // namespace

void check(const Scenario& scenario, const std::string& where) {
  check_parts(scenario, where);
  if (scenario.loop.tex > scenario.planner.tf_max)
    throw InvalidValue(where, fmt::format("tex = {}", scenario.loop.tex),
                       fmt::format("at most tf_max = {}", scenario.planner.tf_max),
                       {"loop.tex", "planner.tf_max"});
  check_start_bounds(scenario, plant_vehicle(scenario.vehicle, scenario.plant, where), where);
  check_held_speed(scenario, where);
  check_start_clear(scenario, where);
  check_goal(scenario, where);
  check_road(scenario, where);
  check_verified(scenario, where);
}

}  // namespace slalom::sim
