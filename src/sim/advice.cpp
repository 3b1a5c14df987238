#include "slalom/sim/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "slalom/vehicle/plant.hpp"
#include "slalom/vehicle/plausible.hpp"
#include "slalom/world/footprint.hpp"
#include "slalom/world/path_exists.hpp"

namespace slalom::sim {
namespace {

using namespace vehicle;

constexpr double kSlowest = 5;       // a plan is not slower than this [m/s]
constexpr double kLongestWay = 600;  // that is searched for [s]
constexpr double kSame = 1e-6;       // of places [m] and of shares of a way

bool verifies(const Scenario& s) {
  return s.planner.method == planner::Method::verified;
}

/// What the vehicle itself takes of a gap [m].
double body_width(const Scenario& s) {
  return s.vehicle.footprint == FootprintKind::point ? 0 : s.vehicle.width;
}

/// Between two obstacles that stand [m].
double gap_between(const world::Obstacle& p, const world::Obstacle& q) {
  if (p.outline) return world::distance(q, p.corners_at(0), 0) - p.rounding;
  if (q.outline) return gap_between(q, p);
  // From each centre to the other's edge along the line between them: exact for circles.
  return world::distance(p, q.x, q.y, 0) + world::distance(q, p.x, p.y, 0) -
         std::hypot(p.x - q.x, p.y - q.y);
}

/// The point of an obstacle nearest to one outside: back by the distance, against its gradient.
world::Point nearest_of(const world::Obstacle& o, world::Point p) {
  constexpr double h = 1e-4;
  const auto d = [&](double x, double y) { return world::distance(o, x, y, 0); };
  const double off = d(p.x, p.y);
  if (off <= 0) return p;
  const world::Point up{d(p.x + h, p.y) - d(p.x - h, p.y), d(p.x, p.y + h) - d(p.x, p.y - h)};
  return p - up * (off / up.norm());
}

/// The ends of the shortest way between two obstacles that stand apart, by projections on either in
/// turn (W. Cheney and A. A. Goldstein, "Proximity maps for convex sets", 1959).
std::pair<world::Point, world::Point> ends_of_gap(const world::Obstacle& p,
                                                  const world::Obstacle& q) {
  constexpr int kTurns = 100;
  std::pair<world::Point, world::Point> ends{{p.x, p.y}, {q.x, q.y}};
  for (int turn = 0; turn < kTurns; ++turn) {
    const world::Point before = ends.first;
    ends.first = nearest_of(p, ends.second);
    ends.second = nearest_of(q, ends.first);
    if ((ends.first - before).norm() < kSame) break;
  }
  return ends;
}

/// Whether an obstacle reaches into the way from a point to another. Along it the distance to a
/// convex body has one minimum.
bool lies_between(const world::Obstacle& o, world::Point from, world::Point to) {
  const world::Point along = to - from;
  if ((world::Point{o.x, o.y} - from).norm() > along.norm() + o.reach()) return false;
  const auto off = [&](double share) {
    const world::Point at = from + along * share;
    return world::distance(o, at.x, at.y, 0);
  };
  double low = 0, high = 1;
  while (high - low > kSame) {
    const double third = (high - low) / 3;
    if (off(low + third) < off(high - third))
      high -= third;
    else
      low += third;
  }
  return off((low + high) / 2) < 0;
}

/// Whether anything that stands fills a part of the gap between two: whoever passes between them
/// then passes between one of them and that.
bool filled(const Scenario& s, const world::Obstacle& p, const world::Obstacle& q) {
  const auto [from, to] = ends_of_gap(p, q);
  return std::any_of(s.obstacles.begin(), s.obstacles.end(), [&, from = from, to = to](auto& o) {
    return &o != &p && &o != &q && !o.moves() && lies_between(o, from, to);
  });
}

/// Rows of obstacles hold at nodes: an obstacle that moves farther between two than it is long,
/// grown, may pass between them.
void passes_between(const Scenario& s, std::vector<std::string>& found) {
  if (verifies(s) || planner::refines(s)) return;
  const double speed = std::max(s.start[UX], kSlowest);
  const double horizon = std::min(s.planner.L_range / speed, s.planner.tf_max);
  const double margin = std::min(s.planner.sm_start, s.planner.sm_end);
  const world::Obstacle* gravest = nullptr;
  double step = 0, covers = 0, closing = 0;
  int count = 0;
  for (const auto& o : s.obstacles) {
    const double speed_of = speed + (s.planner.moving_avoidance ? o.fastest(0, s.loop.timeout) : 0);
    const double step_of = speed_of * horizon / s.planner.N;
    const double across = o.outline ? o.outline->width() : 2 * std::min(o.a, o.b);
    const double covers_of = across + 2 * margin + body_width(s);
    if (step_of <= covers_of) continue;
    ++count;
    if (gravest != nullptr && step_of - covers_of <= step - covers) continue;
    gravest = &o;
    step = step_of;
    covers = covers_of;
    closing = speed_of;
  }
  if (gravest == nullptr) return;
  found.push_back(fmt::format(
      "between two of the {} nodes of a plan, {} and the vehicle come {:.1f} m nearer at {:.3g} "
      "m/s, "
      "and {} with its margin is {:.1f} m across{}: a plan may pass through it unseen; more nodes "
      "(planner.N: {}) or planner.between_nodes: refine help",
      s.planner.N, gravest->name, step, closing, gravest->name, covers,
      count > 1 ? fmt::format(" ({} more likewise)", count - 1) : "",
      static_cast<int>(std::ceil(closing * horizon / covers))));
}

void behind(const Scenario& s, std::vector<std::string>& found) {
  if (s.road || verifies(s) || s.arrived(s.start, 0)) return;  // roads lead around
  const double bearing = std::atan2(s.goal.y - s.start[Y], s.goal.x - s.start[X]) - s.start[PSI];
  const double off = std::fabs(std::remainder(bearing, 2 * std::numbers::pi));
  if (off <= std::numbers::pi / 2) return;
  found.push_back(fmt::format(
      "the goal lies {:.0f} degrees off the vehicle's heading, behind it: planners of the method "
      "receding_horizon keep to the line through the goal and may drive away from it; P_E turns "
      "round",
      off * 180 / std::numbers::pi));
}

void narrow_gaps(const Scenario& s, std::vector<std::string>& found) {
  const double margin =
      verifies(s) ? s.planner.verified_clearance : std::min(s.planner.sm_start, s.planner.sm_end);
  int count = 0;
  double narrowest = INFINITY;
  std::string between;
  for (std::size_t i = 0; i < s.obstacles.size(); ++i)
    for (std::size_t j = i + 1; j < s.obstacles.size(); ++j) {
      const auto &p = s.obstacles[i], &q = s.obstacles[j];
      if (p.moves() || q.moves()) continue;
      const double gap = gap_between(p, q);
      if (gap <= 0 || gap >= 2 * margin + body_width(s) || filled(s, p, q)) continue;
      ++count;
      if (gap < narrowest) {
        narrowest = gap;
        between = fmt::format("{} and {}, {:.2f} m", p.name, q.name, gap);
      }
    }
  if (count > 0)
    found.push_back(fmt::format(
        "{} narrower than twice the margin of {:g} m{} (the narrowest: {}): no plan leads through",
        count == 1 ? "a gap between standing obstacles is"
                   : fmt::format("{} gaps between standing obstacles are", count),
        margin, body_width(s) > 0 ? fmt::format(" and the vehicle's {:g} m", body_width(s)) : "",
        between));
}

/// Until its first plan begins the vehicle goes straight on, whatever the planner finds.
void before_first_plan(const Scenario& s, std::vector<std::string>& found) {
  if (s.loop.latency == LatencyRule::instant) return;
  const Plant plant(s.vehicle, s.loop.plant_tolerance, s.loop.sample_step);
  const world::Footprint footprint(s.vehicle);
  constexpr double kStep = 0.02;  // [s]
  const int steps = static_cast<int>(std::ceil(s.loop.tex / kStep));
  for (int i = 1; i <= steps; ++i) {
    const double t = s.loop.tex * i / steps;
    const State x = plant.advance(s.start, {}, {}, 0, t);
    for (const auto& o : s.obstacles) {
      if (!o.present(t, t) || footprint.distance(o, x, t) >= s.loop.sm_crash) continue;
      found.push_back(fmt::format(
          "before the first plan begins, at {:g} s, the vehicle goes straight on and hits {} at "
          "{:.2f} s, whatever the planner finds",
          s.loop.tex, o.name, t));
      return;
    }
  }
}

void no_way(const Scenario& s, std::vector<std::string>& found) {
  if (s.road || s.goal.kind() != world::GoalKind::square) return;  // not what it searches
  world::PathSearch search;
  search.clearance = verifies(s) ? s.planner.verified_clearance : s.planner.sm_start;
  search.v_max = std::min(search.v_max, s.vehicle.ux_max);
  search.t_max = std::min(s.loop.timeout, kLongestWay);
  if (world::path_exists(s, s.vehicle, s.start, search)) return;
  found.push_back(fmt::format(
      "no way from start to goal was found that keeps {:g} m off all obstacles within {:g} s (a "
      "search that may miss one)",
      search.clearance, search.t_max));
}

}  // namespace

std::vector<std::string> advice_at_start(const Scenario& scenario) {
  std::vector<std::string> found;
  behind(scenario, found);
  return found;
}

std::vector<std::string> advice(const Scenario& scenario) {
  std::vector<std::string> found;
  passes_between(scenario, found);
  behind(scenario, found);
  narrow_gaps(scenario, found);
  before_first_plan(scenario, found);
  no_way(scenario, found);
  for (auto& sentence : implausible(scenario.vehicle)) found.push_back(std::move(sentence));
  return found;
}

}  // namespace slalom::sim
