#include "slalom/planner/lap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "line_problem.hpp"
#include "slalom/base/error.hpp"
#include "solving.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Of what the guess uses, of the most lateral acceleration and braking; and how it accelerates
/// [m/s^2].
constexpr double kShare = 0.6, kDriving = 0.8;
/// Each mesh's intervals are shorter than the last one's by this factor, and a solve ends after so
/// many iterations.
constexpr double kFiner = 1.6;
constexpr int kIterations = 1500;
/// Between the guess's points [m].
constexpr double kStep = 2;

/// In the middle of the road, as fast as the profile allows.
ocp::Trajectory lap_guess(const LineProblem& line, const SpeedProfile& profile) {
  const auto count = static_cast<std::size_t>(std::ceil(line.length() / kStep));
  const double step = line.length() / static_cast<double>(count);
  std::vector<double> speed;
  for (std::size_t k = 0; k < count; ++k)
    speed.push_back(0.95 * profile.at(step * static_cast<double>(k)));
  for (std::size_t k = 0; k < 2 * count; ++k) {  // twice around
    const double v = speed[k % count];
    double& next = speed[(k + 1) % count];
    next = std::min(next, std::sqrt(v * v + 2 * kDriving * step));
  }
  ocp::Trajectory guess;
  guess.tf = line.length();
  for (std::size_t k = 0; k <= count; ++k) {
    const double v = speed[k % count], next = speed[(k + 1) % count];
    const auto x =
        line.cornering(step * static_cast<double>(k), v, (next * next - v * v) / (2 * step));
    guess.tau.push_back(static_cast<double>(k) / static_cast<double>(count));
    guess.states.emplace_back(x.begin(), x.end());
    guess.controls.push_back({0, 0});
  }
  return guess;
}

/// On meshes of ever shorter intervals. Uniform ones, for among intervals that are cut here and
/// there the controls at their limits ring; and each from the calm guess, for from the last mesh's
/// answer, which lies on many bounds, a solve takes longer.
ocp::Refined finer_and_finer(const ocp::Problem& problem, double length,
                             const LapSettings& settings, ocp::SolveSettings solve) {
  ocp::Refined refined;
  double interval = settings.interval;
  for (int mesh = 0; mesh < settings.max_meshes; ++mesh, interval /= kFiner) {
    solve.mesh = ocp::Mesh::uniform(static_cast<int>(std::ceil(length / interval)));
    auto solution = ocp::solve(problem, solve);
    ocp::MeshRecord record;
    record.intervals = solve.mesh.intervals();
    record.points = solution.trajectory.tau.size();
    record.status = solution.status;
    record.iterations = solution.iterations;
    record.wall_s = solution.wall_s;
    record.objective = solution.objective;
    if (!solution.solved()) {
      refined.meshes.push_back(record);
      refined.status = ocp::RefineStatus::not_solved;
      if (mesh == 0) refined.solution = std::move(solution);
      return refined;
    }
    refined.errors = ocp::estimate_errors(problem, solution);
    record.largest_error = refined.errors.largest;
    record.worst_interval = refined.errors.worst;
    record.objective_error =
        mesh == 0 ? INFINITY : std::fabs(record.objective / refined.meshes.back().objective - 1);
    refined.meshes.push_back(record);
    refined.solution = std::move(solution);
    if (record.objective_error < settings.tolerance) {
      refined.status = ocp::RefineStatus::converged;
      return refined;
    }
  }
  refined.status = ocp::RefineStatus::mesh_limit;
  return refined;
}

}  // namespace

Lap fastest_lap(const world::Road& road, const Parameters& vehicle, const LapSettings& settings) {
  if (!road.closed()) throw InvalidValue("lap", "a road with two ends", "a closed one");
  LineProblem line(road, vehicle, road.length(), {settings.margin, 1, settings.w_control});
  auto& problem = line.problem();
  for (const auto& state : line.states())
    problem.boundary("closed " + state.name(), problem.final(state) - problem.initial(state),
                     ocp::Bounds::equal(0));
  ocp::SolveSettings solve;
  solve.guess = lap_guess(line, SpeedProfile(road, vehicle, kShare, kShare));
  // At the tyres' limits the adaptive rule takes several times as many iterations, where it ends.
  solve.options.barrier_rule = nlp::BarrierRule::monotone;
  solve.options.max_iterations = kIterations;
  stop_when(settings.interrupted, solve.options);
  Lap lap;
  lap.refined = finer_and_finer(problem, road.length(), settings, std::move(solve));
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
