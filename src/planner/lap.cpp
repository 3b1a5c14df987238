#include "slalom/planner/lap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "line_problem.hpp"
#include "slalom/base/error.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Of what the guess uses, of the most lateral acceleration and braking; and how it accelerates
/// [m/s^2].
constexpr double kShare = 0.6, kDriving = 0.8;
/// Between the guess's points [m].
constexpr double kStep = 2;

/// In the middle of the road, as fast as the profile allows.
ocp::Trajectory lap_guess(const world::Road& road, const SpeedProfile& profile,
                          const Parameters& p) {
  const auto count = static_cast<std::size_t>(std::ceil(road.length() / kStep));
  const double step = road.length() / static_cast<double>(count);
  std::vector<double> speed;
  for (std::size_t k = 0; k < count; ++k)
    speed.push_back(0.95 * profile.at(step * static_cast<double>(k)));
  for (std::size_t k = 0; k < 2 * count; ++k) {  // twice around
    const double v = speed[k % count];
    double& next = speed[(k + 1) % count];
    next = std::min(next, std::sqrt(v * v + 2 * kDriving * step));
  }
  ocp::Trajectory guess;
  guess.tf = road.length();
  for (std::size_t k = 0; k <= count; ++k) {
    const double kappa = road.at(step * static_cast<double>(k)).curvature, v = speed[k % count];
    const double next = speed[(k + 1) % count], r = v * kappa;
    const double sa = std::clamp(std::atan((p.la + p.lb) * kappa), -p.sa_max(), p.sa_max());
    guess.tau.push_back(static_cast<double>(k) / static_cast<double>(count));
    guess.states.push_back({0, -std::atan2((p.la + p.lb) * r, v), p.lb * r, r, sa, v,
                            (next * next - v * v) / (2 * step)});
    guess.controls.push_back({0, 0});
  }
  return guess;
}

}  // namespace

Lap fastest_lap(const world::Road& road, const Parameters& vehicle, const LapSettings& settings) {
  if (!road.closed()) throw InvalidValue("lap", "a road with two ends", "a closed one");
  LineProblem line(road, vehicle, road.length(), {settings.margin, 1, settings.w_control});
  auto& problem = line.problem();
  for (const auto& state : line.states())
    problem.boundary("closed " + state.name(), problem.final(state) - problem.initial(state),
                     ocp::Bounds::equal(0));
  ocp::SolveSettings start;
  start.mesh = ocp::Mesh::uniform(static_cast<int>(std::ceil(road.length() / settings.interval)));
  start.guess = lap_guess(road, SpeedProfile(road, vehicle, kShare, kShare), vehicle);
  if (settings.interrupted) {
    start.options.stop = [](void* asked) {
      return (*static_cast<std::function<bool()>*>(asked))();
    };
    start.options.stop_data = const_cast<std::function<bool()>*>(&settings.interrupted);
  }
  ocp::RefineRules rules;
  rules.tolerance = settings.tolerance;
  rules.max_meshes = settings.max_meshes;
  rules.resolve_controls = false;
  Lap lap;
  lap.refined = ocp::refine(problem, start, rules);
  const auto& solution = lap.refined.solution;
  if (!solution.solved()) return lap;
  lap.time = solution.cost_term("time");
  auto motion = line.to_world(solution.trajectory, 0, 0, road.at(0).psi);
  lap.s = std::move(motion.s);
  lap.t = std::move(motion.t);
  lap.states = std::move(motion.states);
  lap.controls = std::move(motion.controls);
  return lap;
}

}  // namespace slalom::planner
