#include "slalom/sim/verification.hpp"

#include <algorithm>
#include <cmath>

#include "slalom/planner/belief.hpp"
#include "slalom/sim/sensing.hpp"
#include "slalom/world/footprint.hpp"

namespace slalom::sim {
namespace {

using namespace vehicle;

/// How far a point `reach` [m] off the middle moves at the most between two poses [m].
double farthest(double dx, double dy, double turned, double reach) {
  return std::hypot(dx, dy) + 2 * reach * std::fabs(std::sin(turned / 2));
}

/// Where a plan has the vehicle at t [s].
State planned(const planner::Plan& plan, double t) {
  const auto after = static_cast<std::size_t>(
      std::upper_bound(plan.t.begin(), plan.t.end(), t - plan.t_start) - plan.t.begin());
  if (after == 0) return plan.states.front();
  if (after == plan.t.size()) return plan.states.back();
  const double share = (t - plan.t_start - plan.t[after - 1]) / (plan.t[after] - plan.t[after - 1]);
  State state = plan.states[after - 1];
  for (std::size_t i = 0; i < kStates; ++i) state[i] += share * (plan.states[after][i] - state[i]);
  return state;
}

/// What the planner of a cycle knew of an obstacle.
std::optional<world::Obstacle> belief(const Scenario& scenario, const Cycle& cycle,
                                      const std::string& name) {
  planner::Request request;
  request.X0p = cycle.X0p;
  request.t0 = cycle.t0;
  request.t_start = cycle.plan.t_start;
  request.obstacles = Sensors(scenario.sensing, scenario.plant.cg_shift)
                          .believed(scenario.obstacles, cycle.index, cycle.t0);
  const auto known = planner::known_obstacles(scenario, request);
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const auto& o) { return o.name == name; });
  if (found == known.end()) return std::nullopt;
  return *found;
}

}  // namespace

std::optional<Verification> verification(const Drive& drive) {
  const bool verifies = std::any_of(drive.cycles.begin(), drive.cycles.end(), [](const auto& c) {
    return c.plan.rung != planner::Rung::none;
  });
  if (!verifies) return std::nullopt;
  Verification count;
  for (const auto& cycle : drive.cycles) {
    if (cycle.index == 0) continue;
    ++count.cycles;
    ++count.of_rung.at(static_cast<std::size_t>(cycle.plan.rung));
    if (cycle.plan.certificate.verified) continue;
    if (count.unverified++ > 0) continue;
    count.first_unverified_t = cycle.t_swap;
    count.first_refused = cycle.plan.report.status_text();
  }
  return count;
}

std::optional<VerifiedCrash> verified_crash(const Scenario& scenario, const Drive& drive) {
  if (drive.outcome != Outcome::crash || drive.plant.empty()) return std::nullopt;
  const auto driven =
      std::find_if(drive.cycles.rbegin(), drive.cycles.rend(),
                   [&](const Cycle& cycle) { return cycle.used && cycle.t_swap <= drive.time; });
  if (driven == drive.cycles.rend() || !driven->plan.certificate.verified) return std::nullopt;
  const auto hit = std::find_if(scenario.obstacles.begin(), scenario.obstacles.end(),
                                [&](const auto& o) { return o.name == drive.hit; });
  if (hit == scenario.obstacles.end()) return std::nullopt;
  const PlantSample& end = drive.plant.back();
  VerifiedCrash crash;
  crash.cycle = driven->index;
  crash.kept = driven->plan.certificate.proved_clearance - scenario.loop.sm_crash;
  const State& at = end.state;
  const State plan = planned(driven->plan, end.t);
  crash.off_plan = farthest(at[X] - plan[X], at[Y] - plan[Y], at[PSI] - plan[PSI],
                            world::Footprint(scenario.vehicle).reach());
  if (const auto believed = belief(scenario, *driven, drive.hit)) {
    const world::Pose is = hit->pose_at(end.t), was = believed->pose_at(end.t);
    crash.off_belief = farthest(is.x - was.x, is.y - was.y, is.psi - was.psi, hit->reach());
  }
  return crash;
}

}  // namespace slalom::sim
