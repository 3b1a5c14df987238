#pragma once

#include <utility>
#include <vector>

#include "slalom/problems/library.hpp"

namespace slalom::problems {

using ocp::Bounds;
using ocp::Expr;
using ocp::PhasedProblem;
using ocp::Problem;

using Entries = std::vector<Entry>;

/// Fixes a state at t0, at tf, or at both.
inline void starts(Problem& p, const Expr& state, double value) {
  p.initial_bounds(state, Bounds::equal(value));
}
inline void ends(Problem& p, const Expr& state, double value) {
  p.final_bounds(state, Bounds::equal(value));
}
inline void fixed(Problem& p, const Expr& state, double from, double to) {
  starts(p, state, from);
  ends(p, state, to);
}
inline void horizon(Problem& p, double tf) {
  p.final_time(Bounds::equal(tf), tf);
}
/// Least final time, within `bounds`.
inline void least_time(Problem& p, Bounds bounds, double guess) {
  p.final_time(bounds, guess);
  p.mayer("final time", p.final_time());
}

/// A guess of straight lines from t0 to tf.
inline ocp::Trajectory line(double t0, double tf, std::vector<double> states_from,
                            std::vector<double> states_to, std::vector<double> controls_from,
                            std::vector<double> controls_to) {
  return {t0,
          tf,
          {0, 1},
          {std::move(states_from), std::move(states_to)},
          {std::move(controls_from), std::move(controls_to)},
          {},
          {}};
}

// The library's parts, by subject.
Entries classics();
Entries singular_arcs();
Entries state_constraints();
Entries bang_bang();
Entries phases();
Entries parameter_estimation();
Entries aerospace();
Entries biology();
Entries ascent();

}  // namespace slalom::problems
