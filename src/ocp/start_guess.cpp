#include "start_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

/// A finite value within bounds: their middle, the finite side, or 0.
double middle(Bounds bounds) {
  const bool lower = std::isfinite(bounds.lower), upper = std::isfinite(bounds.upper);
  if (lower && upper) return 0.5 * (bounds.lower + bounds.upper);
  return lower ? std::max(bounds.lower, 0.0) : upper ? std::min(bounds.upper, 0.0) : 0.0;
}

Bounds intersection(Bounds a, Bounds b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

}  // namespace

Trajectory straight_guess(const Problem& problem) {
  Trajectory guess;
  guess.t0 = problem.t0().guess;
  guess.tf = problem.tf().guess;
  guess.tau = {0, 1};
  guess.states.assign(2, {});
  guess.controls.assign(2, {});
  for (const auto& state : problem.states()) {
    guess.states[0].push_back(middle(intersection(state.bounds, state.initial)));
    guess.states[1].push_back(middle(intersection(state.bounds, state.final)));
  }
  for (auto& controls : guess.controls)
    for (const auto& control : problem.controls()) controls.push_back(middle(control.bounds));
  return guess;
}

void check_guess(const Trajectory& guess, const Problem& problem) {
  const std::string where = problem.name() + ": guess";
  const std::size_t points = guess.tau.size();
  if (points == 0) throw InvalidValue(where, "no points", "at least one");
  const auto check_rows = [&](const std::vector<std::vector<double>>& rows, const char* what,
                              std::size_t width) {
    if (rows.size() != points)
      throw InvalidValue(where, fmt::format("{} points of {}", rows.size(), what),
                         fmt::format("{}, one a tau", points));
    for (std::size_t k = 0; k < points; ++k)
      if (rows[k].size() != width)
        throw InvalidValue(where, fmt::format("{} {} at point {}", rows[k].size(), what, k),
                           fmt::format("{}", width));
  };
  check_rows(guess.states, "states", problem.states().size());
  check_rows(guess.controls, "controls", problem.controls().size());
}

}  // namespace slalom::ocp
