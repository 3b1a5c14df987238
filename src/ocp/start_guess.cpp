#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bounds.hpp"
#include "slalom/base/error.hpp"
#include "slalom/ocp/guess.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

/// A finite value within bounds: their middle, the finite side, or 0.
double middle(Bounds bounds) {
  const bool lower = std::isfinite(bounds.lower), upper = std::isfinite(bounds.upper);
  if (lower && upper) return 0.5 * (bounds.lower + bounds.upper);
  return lower ? std::max(bounds.lower, 0.0) : upper ? std::min(bounds.upper, 0.0) : 0.0;
}

std::string place(const Problem& problem) {
  return problem.name() + ": guess";
}

void check_finite(const Problem& problem, const std::string& what, double value) {
  if (!std::isfinite(value))
    throw InvalidValue(place(problem), fmt::format("{} = {}", what, value), "a finite number");
}

template <class List>
void check_once(const Problem& problem, const List& variables, const Vector& values,
                const char* what) {
  if (values.size() > variables.size())
    throw InvalidValue(place(problem), fmt::format("{} {}", values.size(), what),
                       fmt::format("at most {}", variables.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    check_finite(problem, variables[i].name, values[i]);
}

template <class List>
void check_points(const Problem& problem, const List& variables, const std::vector<Vector>& rows,
                  std::size_t points, const char* what) {
  if (rows.size() != points)
    throw InvalidValue(place(problem), fmt::format("{} points of {}", rows.size(), what),
                       fmt::format("{}, one for each tau", points));
  for (std::size_t k = 0; k < points; ++k) {
    if (rows[k].size() != variables.size())
      throw InvalidValue(place(problem), fmt::format("{} {} at point {}", rows[k].size(), what, k),
                         fmt::format("{}", variables.size()));
    for (std::size_t i = 0; i < variables.size(); ++i)
      if (!std::isfinite(rows[k][i]))
        check_finite(problem, fmt::format("{} at point {}", variables[i].name, k), rows[k][i]);
  }
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
    guess.states[0].push_back(middle(end_bounds(state, false)));
    guess.states[1].push_back(middle(end_bounds(state, true)));
  }
  for (auto& controls : guess.controls)
    for (const auto& control : problem.controls()) controls.push_back(middle(control.bounds));
  return guess;
}

Trajectory held_guess(const Problem& problem) {
  Trajectory guess = straight_guess(problem);
  for (std::size_t i = 0; i < problem.states().size(); ++i) {
    const auto& state = problem.states()[i];
    const Bounds ends[] = {end_bounds(state, false), end_bounds(state, true)};
    for (const int end : {0, 1})
      if (tells_a_value(ends[1 - end]) && !tells_a_value(ends[end]))
        guess.states[end][i] =
            std::clamp(guess.states[1 - end][i], ends[end].lower, ends[end].upper);
  }
  return guess;
}

void check_guess(const Trajectory& guess, const Problem& problem) {
  const std::size_t points = guess.tau.size();
  if (points == 0) throw InvalidValue(place(problem), "no points", "at least one");
  check_points(problem, problem.states(), guess.states, points, "states");
  check_points(problem, problem.controls(), guess.controls, points, "controls");
  check_once(problem, problem.static_parameters(), guess.static_parameters, "static parameters");
  check_once(problem, problem.slacks(), guess.slacks, "slacks");
  check_once(problem, problem.integrals(), guess.integrals, "integrals");
  check_finite(problem, "t0", guess.t0);
  check_finite(problem, "tf", guess.tf);
  if (guess.tf < guess.t0)
    throw InvalidValue(place(problem), fmt::format("tf = {} before t0 = {}", guess.tf, guess.t0),
                       "tf >= t0");
  for (std::size_t k = 0; k < points; ++k)
    if (std::isnan(guess.tau[k]) || (k > 0 && guess.tau[k] < guess.tau[k - 1]))
      throw InvalidValue(place(problem), fmt::format("tau = {} at point {}", guess.tau[k], k),
                         "taus that increase");
}

}  // namespace slalom::ocp
