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

/// Solves a problem for many sets of numbers, in their order; all variations have as many. It is
/// transcribed once in each of `threads` threads (0: as many as there are processors). Each solve
/// starts from what the settings say (guess, or `previous` with its multipliers) and depends on
/// nothing else, so its answer has the same bits whatever is solved beside it. Scales are those of
/// the problem as it is given. A solve is tried once: what ends infeasible is not begun anew from
/// elsewhere, as solve() does.
///
/// options.stop is called on the calling thread alone; once it says so, what is under way ends, and
/// the rest is `interrupted`, without a trajectory. options.on_iteration is called on all threads.
///
/// Throws InvalidValue for settings as solve() does, and for a warm_start (`previous` is for that);
/// for a name that is not there, lists of different lengths, numbers that are not finite, and a
/// negative `threads`.
[[nodiscard]] std::vector<Solution> solve_many(const Problem& problem,
                                               const SolveSettings& settings,
                                               const std::vector<Variation>& variations,
                                               int threads = 0);

}  // namespace slalom::ocp
