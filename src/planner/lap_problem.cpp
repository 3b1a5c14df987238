#include "lap_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "slalom/base/error.hpp"
#include "solving.hpp"

namespace slalom::planner {
namespace {

/// Of what the guess uses, of the most lateral acceleration and braking; and how it accelerates
/// [m/s^2].
constexpr double kShare = 0.6, kDriving = 0.8;
/// Between the guess's points [m].
constexpr double kStep = 2;
/// A solve ends after so many iterations.
constexpr int kIterations = 1500;

/// Typical sizes of n [m], xi [rad], v [m/s], r [rad/s], sa [rad], ux [m/s] and ax [m/s^2] around a
/// lap. What ocp::with_scales() makes of a horizon of kilometres is off by powers of ten, the
/// objective's scale with it, and then a solve may not end.
constexpr std::array<double, LineProblem::kLineStates> kSizes = {1, 0.1, 0.5, 0.5, 0.1, 10, 5};

const world::Road& closed(const world::Road& road) {
  if (!road.closed()) throw InvalidValue("lap", "a road with two ends", "a closed one");
  return road;
}

/// In the middle of the road, as fast as the profile allows.
ocp::Trajectory lap_guess(const LineProblem& line, const SpeedProfile& profile) {
  const auto count =
      std::max(static_cast<std::size_t>(std::ceil(line.length() / kStep)), std::size_t{2});
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
    const std::size_t here = k < count ? k : 0, after = here + 1 < count ? here + 1 : 0;
    const double v = speed[here], next = speed[after];
    const auto x =
        line.cornering(step * static_cast<double>(k), v, (next * next - v * v) / (2 * step));
    guess.tau.push_back(static_cast<double>(k) / static_cast<double>(count));
    guess.states.emplace_back(x.begin(), x.end());
    guess.controls.push_back({0, 0});
  }
  return guess;
}

}  // namespace

LapProblem::LapProblem(const world::Road& road, const vehicle::Parameters& vehicle,
                       const LapSettings& settings)
    : line_(closed(road), vehicle, road.length(), {settings.margin, 1, settings.w_control}) {
  auto& problem = line_.problem();
  for (std::size_t i = 0; i < kSizes.size(); ++i) problem.set_scale(line_.states()[i], kSizes[i]);
  for (const auto& state : line_.states())
    problem.boundary("closed " + state.name(), problem.final(state) - problem.initial(state),
                     ocp::Bounds::equal(0));
  solve_.guess = lap_guess(line_, SpeedProfile(road, vehicle, kShare, kShare));
  // At the tyres' limits the adaptive rule takes several times as many iterations, where it ends.
  solve_.options.barrier_rule = nlp::BarrierRule::monotone;
  solve_.options.max_iterations = kIterations;
  stop_when(settings.interrupted, solve_.options);
}

ocp::SolveSettings LapProblem::solve_on(int intervals) const {
  ocp::SolveSettings solve = solve_;
  solve.mesh = ocp::Mesh::uniform(intervals);
  return solve;
}

}  // namespace slalom::planner
