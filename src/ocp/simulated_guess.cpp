#include "simulated_guess.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/simulate.hpp"

namespace slalom::ocp {
namespace {

/// What such a guess may take.
constexpr double kSimulation_s = 1;

}  // namespace

bool simulated(const Problem& problem, double share, double time_limit, SolveSettings& settings) {
  const Trajectory straight = straight_guess(problem);
  std::vector<double> controls = straight.controls.front();
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const Bounds bounds = problem.controls()[i].bounds;
    if (std::isfinite(bounds.lower) && std::isfinite(bounds.upper))
      controls[i] = bounds.lower + share * (bounds.upper - bounds.lower);
  }
  const Timer timer;
  const nlp::Options& options = settings.options;
  SimulateSettings rules{.tolerance = 1e-6};
  rules.stop = [&] {
    return timer.wall() > std::min(time_limit, kSimulation_s) ||
           (options.stop != nullptr && options.stop(options.stop_data));
  };
  try {
    Simulation found =
        simulate(problem, straight.states.front(), constant_controls(controls), rules);
    settings.guess = std::move(found.trajectory);
    return found.complete;
  } catch (const InvalidValue&) {  // dynamics that use final values
    return false;
  }
}

}  // namespace slalom::ocp
