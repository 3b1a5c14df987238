#include "slalom/sim/marks.hpp"

#include "slalom/sim/verification.hpp"
#include "slalom/world/footprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

namespace slalom::sim {
namespace {

using namespace vehicle;

// What is not worth a mark.
constexpr double kDistance = 0.1;                    // [m]
constexpr double kHeading = std::numbers::pi / 180;  // [rad]
constexpr double kLoad = 100;                        // [N]
constexpr double kSpeed = 0.1;                       // [m/s]
constexpr double kAway = 10;                         // [s]
constexpr double kBack = 5;                          // [m]

/// Cases of one kind, and the gravest of them.
template <class T>
struct Cases {
  std::vector<double> times;
  double most = 0;
  T gravest{};

  void add(double t, double size, const T& one) {
    times.push_back(t);
    if (times.size() > 1 && size <= most) return;
    most = size;
    gravest = one;
  }
};

std::string plans(std::size_t count, const char* one, const char* several) {
  return count == 1 ? fmt::format("1 plan {}", one) : fmt::format("{} plans {}", count, several);
}

/// Plans that pass through something, as their status says: of `depth` [m] in the gravest, which
/// `text` says, and what helps.
std::optional<Mark> passing(const Drive& drive, const char* kind,
                            const std::function<double(const planner::SolveReport&)>& depth,
                            const std::function<std::string(std::size_t, const Cycle&)>& text,
                            const char* remedy) {
  Cases<const Cycle*> cases;
  for (const auto& cycle : drive.cycles) {
    const auto& report = cycle.plan.report;
    if (cycle.index == 0 || report.status != planner::PlanStatus::passes_through) continue;
    if (const double size = depth(report); size > 0) cases.add(cycle.t_swap, size, &cycle);
  }
  if (cases.times.empty()) return std::nullopt;
  return Mark{kind,
              fmt::format("{} (cycle {}); {}", text(cases.times.size(), *cases.gravest),
                          cases.gravest->index, remedy),
              cases.times};
}

/// Of what rows at the nodes do not know.
const char* finer_meshes(const Scenario& scenario) {
  return planner::refines(scenario) ? "finer meshes did not help"
                                    : "planner.between_nodes: refine would solve again";
}

std::optional<Mark> through_obstacles(const Scenario& scenario, const Drive& drive) {
  const double allowed = scenario.planner.most_passage();
  return passing(
      drive, "passes_through",
      [&](const auto& report) {
        return report.passage.unseen() > allowed ? report.passage.depth : 0;
      },
      [](std::size_t count, const Cycle& cycle) {
        const auto& passage = cycle.plan.report.passage;
        return fmt::format(
            "{} through an obstacle between nodes, the deepest {:.2f} m into the margin of {} at "
            "{:.2f} s",
            plans(count, "goes", "go"), passage.depth, passage.obstacle, passage.t);
      },
      finer_meshes(scenario));
}

/// Plans that soft rows know of: they pay for it.
std::optional<Mark> let_in(const Scenario& scenario, const Drive& drive) {
  const double allowed = scenario.planner.most_passage();
  return passing(
      drive, "soft_obstacle",
      [&](const auto& report) {
        const auto& passage = report.passage;
        return passage.depth > allowed && passage.unseen() <= allowed ? passage.depth : 0;
      },
      [](std::size_t count, const Cycle& cycle) {
        const auto& passage = cycle.plan.report.passage;
        return fmt::format(
            "{} into an obstacle as its soft rows allow, the deepest {:.2f} m into the margin of "
            "{} at {:.2f} s",
            plans(count, "goes", "go"), passage.depth, passage.obstacle, passage.t);
      },
      "a greater planner.w_obstacle makes it dearer, planner.obstacle_constraint: hard forbids it");
}

std::optional<Mark> through_edges(const Scenario& scenario, const Drive& drive) {
  return passing(
      drive, "plan_off_road", [](const auto& report) { return report.road_exit.depth; },
      [](std::size_t count, const Cycle& cycle) {
        const auto& exit = cycle.plan.report.road_exit;
        return fmt::format(
            "{} the road between nodes, the farthest by {:.2f} m at its {} edge at {:.2f} s",
            plans(count, "leaves", "leave"), exit.depth, exit.edge(), exit.t);
      },
      finer_meshes(scenario));
}

std::optional<Mark> beside(const Drive& drive) {
  Cases<std::pair<int, StartSlack>> cases;
  for (const auto& cycle : drive.cycles) {
    const StartSlack slack = start_slack(cycle);
    if (!cycle.used || (slack.distance <= kDistance && slack.heading <= kHeading)) continue;
    cases.add(cycle.t_swap, std::max(slack.distance / kDistance, slack.heading / kHeading),
              {cycle.index, slack});
  }
  if (cases.times.empty()) return std::nullopt;
  const auto& [index, slack] = cases.gravest;
  return Mark{"start_slack",
              fmt::format("{} beside the vehicle, by up to {:.2f} m and {:.1f} degrees (cycle {})",
                          plans(cases.times.size(), "begins", "begin"), slack.distance,
                          slack.heading / kHeading, index),
              cases.times};
}

/// A limit that the plant is beyond for a while, once for each while: `beyond` gives by how much,
/// `text` says so of the sample where it is most.
std::optional<Mark> broken(const Drive& drive, const char* kind, double slack,
                           const std::function<double(const PlantSample&)>& beyond,
                           const std::function<std::string(const PlantSample&)>& text) {
  Cases<const PlantSample*> cases;
  bool was = false;
  for (const auto& sample : drive.plant) {
    const double size = beyond(sample);
    const bool is = size > slack;
    if (is && !was)
      cases.add(sample.t, size, &sample);
    else if (is && size > cases.most) {
      cases.most = size;
      cases.gravest = &sample;
    }
    was = is;
  }
  if (cases.times.empty()) return std::nullopt;
  return Mark{kind, text(*cases.gravest), cases.times};
}

std::optional<Mark> low_load(const Scenario& scenario, const Drive& drive) {
  const double kept = scenario.planner.method == planner::Method::verified
                          ? scenario.planner.verified_wheel_load
                          : scenario.vehicle.Fz_min;
  const auto least = [](const PlantSample& s) {
    return std::min_element(s.wheel_loads.begin(), s.wheel_loads.end());
  };
  return broken(
      drive, "wheel_load", kLoad, [&](const auto& s) { return kept - *least(s); },
      [&](const auto& s) {
        return fmt::format("the {} wheel's load fell to {:.0f} N at {:.2f} s; plans keep {:.0f} N",
                           kWheelNames[static_cast<std::size_t>(least(s) - s.wheel_loads.begin())],
                           *least(s), s.t, kept);
      });
}

std::optional<Mark> speed(const Scenario& scenario, const Drive& drive) {
  const double lo = scenario.vehicle.ux_min, hi = scenario.vehicle.ux_max;
  return broken(
      drive, "speed", kSpeed,
      [&](const auto& s) { return std::max(lo - s.state[UX], s.state[UX] - hi); },
      [&](const auto& s) {
        return fmt::format("the speed came to {:.2f} m/s at {:.2f} s; plans keep {:g} to {:g} m/s",
                           s.state[UX], s.t, lo, hi);
      });
}

std::optional<Mark> outside(const Scenario& scenario, const Drive& drive) {
  const world::Footprint footprint(scenario.vehicle);
  const auto beyond = [&](const PlantSample& s) {
    return footprint.outside(scenario.region, s.state);
  };
  return broken(drive, "region", kDistance, beyond, [&](const auto& s) {
    return fmt::format("the vehicle was {:.2f} m outside the region at {:.2f} s; plans stay within",
                       beyond(s), s.t);
  });
}

/// How deep a body is in the obstacle that it is deepest in [m], and which that is; at most 0: in
/// none.
std::pair<double, const world::Obstacle*> overlap(const world::Footprint& body,
                                                  const std::vector<world::Obstacle>& obstacles,
                                                  const PlantSample& s) {
  std::pair<double, const world::Obstacle*> deepest{0, nullptr};
  for (const auto& o : obstacles) {
    if (!o.present(s.t, s.t)) continue;
    const world::Pose at = o.pose_at(s.t);
    // Far ones, which are most.
    if (std::hypot(s.state[X] - at.x, s.state[Y] - at.y) > body.reach() + o.reach()) continue;
    const double depth = -body.distance(o, s.state, s.t);
    if (depth > deepest.first) deepest = {depth, &o};
  }
  return deepest;
}

/// A point's drive is judged by its distance, which the body behind the front axle does not keep.
std::optional<Mark> overlapping(const Scenario& scenario, const Drive& drive) {
  if (scenario.vehicle.footprint != FootprintKind::point) return std::nullopt;
  Parameters vehicle = scenario.vehicle;
  vehicle.footprint = FootprintKind::rectangle;
  const world::Footprint body(vehicle);
  const auto of = [&](const PlantSample& s) { return overlap(body, scenario.obstacles, s); };
  return broken(
      drive, "body_overlap", 0, [&](const auto& s) { return of(s).first; },
      [&](const auto& s) {
        const auto [depth, obstacle] = of(s);
        return fmt::format(
            "the vehicle's body, {:g} m by {:g} m, was {:.2f} m deep in {} at {:.2f} s; with "
            "vehicle.footprint: point only its front axle's centre keeps off obstacles, "
            "rectangle has all of it",
            vehicle.length, vehicle.width, depth, obstacle->name, s.t);
      });
}

/// Time more than kBack farther from the goal than ever before counts, until the vehicle is nearer
/// by as much: one that circles comes back again and again and gets nowhere.
std::optional<Mark> away(const Scenario& scenario, const Drive& drive) {
  const auto& goal = scenario.goal;
  if (scenario.road) return std::nullopt;  // roads lead around
  std::vector<double> times;
  double nearest = INFINITY, nearest_t = 0;              // so far
  double before = INFINITY, since = 0, time = 0, t = 0;  // of the time away: nearest, begin, sum
  double grown = 0;
  for (const auto& sample : drive.plant) {
    const double d = std::hypot(sample.state[X] - goal.x, sample.state[Y] - goal.y);
    if (d < nearest) {
      nearest = d;
      nearest_t = sample.t;
      if (nearest < before - kBack) time = 0;
    } else if (d > nearest + kBack) {
      if (time == 0) {
        before = nearest;
        since = nearest_t;
      }
      time += sample.t - t;
      if (time >= kAway) {
        if (times.empty() || times.back() != since) times.push_back(since);
        grown = std::max(grown, d - nearest);
      }
    }
    t = sample.t;
  }
  if (times.empty()) return std::nullopt;
  return Mark{"moves_away",
              fmt::format("the vehicle moves away from the goal from {:.2f} s on: for more than "
                          "{:g} s it is up to {:.0f} m farther off",
                          times.front(), kAway, grown),
              times};
}

/// A certificate that did not hold, for what was believed was not so.
std::optional<Mark> crash_by_verified_plan(const Scenario& scenario, const Drive& drive) {
  const auto crash = verified_crash(scenario, drive);
  if (!crash) return std::nullopt;
  return Mark{
      "verified_crash",
      fmt::format("the plan that was driven at the crash (cycle {}) was verified, {:.2f} m beyond "
                  "the edge of a crash: the vehicle was {:.2f} m off it, and {}",
                  crash->cycle, crash->kept, crash->off_plan,
                  crash->off_belief ? fmt::format("{} {:.2f} m from where it was believed",
                                                  drive.hit, *crash->off_belief)
                                    : fmt::format("of {} the planner did not know", drive.hit)),
      {drive.time}};
}

}  // namespace

StartSlack start_slack(const Cycle& cycle) {
  if (cycle.plan.empty()) return {};
  const State& at = cycle.plan.states.front();
  return {std::hypot(at[X] - cycle.X0p[X], at[Y] - cycle.X0p[Y]),
          std::fabs(at[PSI] - cycle.X0p[PSI])};
}

std::vector<Mark> marks(const Scenario& scenario, const Drive& drive) {
  std::vector<Mark> result;
  for (auto& mark : {through_obstacles(scenario, drive), let_in(scenario, drive),
                     through_edges(scenario, drive), beside(drive), low_load(scenario, drive),
                     speed(scenario, drive), outside(scenario, drive), overlapping(scenario, drive),
                     away(scenario, drive), crash_by_verified_plan(scenario, drive)})
    if (mark) result.push_back(*mark);
  return result;
}

}  // namespace slalom::sim
