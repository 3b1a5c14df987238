#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// A number of a problem that differs from one solve to the next.
struct Variation {
  /// One of sensitivity_numbers() that with_numbers() takes, such as a parameter or "initial x".
  std::string name;
  std::vector<double> values;  ///< one for each solve
};

/// Solves a problem for many sets of numbers, in their order; all variations have the same length.
/// The problem is transcribed once in each of `threads` threads (0: as many as there are
/// processors). Each solve starts from the settings' guess, or `previous` with its multipliers, and
/// depends on nothing else, so its answer has the same bits whatever else is solved. Scales are
/// those of the given problem. Each solve is tried once: after an infeasible end there is no new
/// start from elsewhere, unlike solve().
///
/// options.stop is called only on the calling thread. Once it returns true, set-up and running
/// solves end, and the others are `interrupted`, without a trajectory. options.time_limit is of
/// each solve, without the set-up. options.on_iteration is called on all threads.
///
/// Throws InvalidValue for settings as solve() does, for a warm_start (use `previous`), for an
/// unknown name, lists of different lengths, numbers that are not finite, and a negative `threads`.
[[nodiscard]] std::vector<Solution> solve_many(const Problem& problem,
                                               const SolveSettings& settings,
                                               const std::vector<Variation>& variations,
                                               int threads = 0);

}  // namespace slalom::ocp
