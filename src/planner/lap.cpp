#include "slalom/planner/lap.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lap_problem.hpp"
#include "slalom/base/error.hpp"

namespace slalom::planner {
namespace {

/// Each mesh's intervals are shorter than the last one's by this factor.
constexpr double kFiner = 1.6;

/// On meshes of ever shorter intervals. Uniform ones, for among intervals that are cut here and
/// there the controls at their limits ring; and each from the calm guess, for from the last mesh's
/// answer, which lies on many bounds, a solve takes longer.
ocp::Refined finer_and_finer(const LapProblem& lap, const LapSettings& settings) {
  const auto& problem = lap.problem();
  ocp::Refined refined;
  double interval = settings.interval;
  for (int mesh = 0; mesh < settings.max_meshes; ++mesh, interval /= kFiner) {
    const auto solve = lap.solve_on(static_cast<int>(std::ceil(lap.line().length() / interval)));
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

double least_lap_interval(const world::Road& road) {
  constexpr double kMostIntervals = 100000;
  return road.length() / kMostIntervals;
}

Lap fastest_lap(const world::Road& road, const vehicle::Parameters& vehicle,
                const LapSettings& settings) {
  // Neither NaN, which is no less, nor infinity makes a number of intervals.
  if (!std::isfinite(settings.interval) || settings.interval < least_lap_interval(road))
    throw InvalidValue("LapSettings::interval", fmt::format("{}", settings.interval),
                       fmt::format("a finite length of at least {} m", least_lap_interval(road)));
  const LapProblem problem(road, vehicle, settings);
  Lap lap;
  lap.refined = finer_and_finer(problem, settings);
  const auto& solution = lap.refined.solution;
  if (!solution.solved()) return lap;
  lap.time = solution.cost_term("time");
  auto motion = problem.line().to_world(solution.trajectory, 0, 0, road.at(0).psi);
  lap.s = std::move(motion.s);
  lap.t = std::move(motion.t);
  lap.states = std::move(motion.states);
  lap.controls = std::move(motion.controls);
  return lap;
}

}  // namespace slalom::planner
