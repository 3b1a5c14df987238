#include "simulated_guess.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/ocp/guess.hpp"

namespace slalom::ocp {
namespace {

/// What such a guess may take.
constexpr double kSimulation_s = 1;

}  // namespace

std::optional<Trajectory> led_by(const Problem& problem, const Trajectory& from,
                                 const Controls& controls, const nlp::Options& limits) {
  const Timer timer;
  SimulateSettings rules{.t0 = from.t0, .tf = from.tf, .tolerance = 1e-6};
  rules.stop = [&] {
    return timer.wall() > std::min(limits.time_limit, kSimulation_s) ||
           (limits.stop != nullptr && limits.stop(limits.stop_data));
  };
  try {
    Simulation found = simulate(system_of(problem, from), from.states.front(), controls, rules);
    if (!found.complete) return std::nullopt;
    found.trajectory.static_parameters = from.static_parameters;
    found.trajectory.slacks = from.slacks;
    return std::move(found.trajectory);
  } catch (const InvalidValue&) {  // dynamics that use final values
    return std::nullopt;
  }
}

bool simulated(const Problem& problem, double share, double time_limit, SolveSettings& settings) {
  const Trajectory straight = straight_guess(problem);
  std::vector<double> controls = straight.controls.front();
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const Bounds bounds = problem.controls()[i].bounds;
    if (std::isfinite(bounds.lower) && std::isfinite(bounds.upper))
      controls[i] = bounds.lower + share * (bounds.upper - bounds.lower);
  }
  nlp::Options limits = settings.options;
  limits.time_limit = time_limit;
  auto found = led_by(problem, straight, constant_controls(controls), limits);
  if (found) settings.guess = std::move(*found);
  return found.has_value();
}

}  // namespace slalom::ocp
