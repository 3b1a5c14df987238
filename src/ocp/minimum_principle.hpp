#pragma once

#include <optional>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// How far an answer's controls are from Pontryagin's minimum principle: at each moment, they give
/// H = L + costate' f its least value of all that bounds and path rows allow (Bryson & Ho 1975,
/// section 3.4). An answer for which a step of each control at each point was only stationary may
/// be far from it.
struct HamiltonianGap {
  /// The integral over time of H less its least value among those tried [unit of the objective]: to
  /// first order, what those controls would gain together.
  double value = 0;
  /// The same without intervals at and beside which a state is at a bound. Costates are less exact
  /// there, for the multipliers of such bounds are impulses.
  double away_from_bounds = 0;
  double size = 0;  ///< the integral of |L| + |costate|' |f|, by the answer's own controls
  std::vector<std::vector<double>> controls;  ///< [point][control] with that least value
};

/// Tries values of each control over its bounds or, where it has none, beyond its own range. Not
/// judged, so 0, are problems with integrals, whose multipliers count in H, or with a family of
/// numbers by point, and solutions without costates. Controls with a form of their own between the
/// nodes stay as they are.
HamiltonianGap hamiltonian_gap(const Problem& problem, const Solution& solution);

/// What the states of a guess with other controls are.
enum class GuessedStates {
  kept,       ///< the answer's
  simulated,  ///< where those controls lead from the answer's start
};
/// A guess with the gap's controls; none where the simulation does not come to the end in time,
/// which is the options' limit at the most.
std::optional<Trajectory> guess_by(const Problem& problem, const Solution& solution,
                                   const HamiltonianGap& gap, GuessedStates states,
                                   const nlp::Options& limits);

}  // namespace slalom::ocp
