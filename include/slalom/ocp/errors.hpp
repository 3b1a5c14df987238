#pragma once

#include <string>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {

/// The distance of a solution's states from the dynamics, found by integrating the dynamics again
/// (Bulirsch & Stoer's extrapolation) with the solution's own controls. Errors are relative: |error
/// of state i| / (scale_i + largest |state i|), the measure of Patterson, Hager & Rao, Optim.
/// Control Appl. Meth. 36(4), 2015, eq. 27, with the state's scale in place of 1. The cost's
/// integral and the problem's integrals count as states, so that quadratures are judged too; their
/// errors are relative to the sum of the magnitudes of their parts (and to the whole objective).
struct ErrorEstimate {
  std::vector<double> interval;    ///< largest over the states, from the interval's start
  std::vector<std::string> state;  ///< the state with it, or "the cost's integral"
  double largest = 0;              ///< over the intervals
  std::size_t worst = 0;           ///< that interval
  double horizon = 0;              ///< largest at a node when integrated from t0 without restarts
  /// `horizon` divided by the sum of the intervals' errors: about 1 for neutral dynamics, large for
  /// unstable dynamics, where no open-loop control can reproduce the states.
  double amplification = 0;
  /// The first-order effect of these errors on the objective: each interval's errors of the states
  /// times their costates at its end, plus its error of the cost's integral. The sum is the change
  /// of the objective if the errors were removed.
  double objective = 0;
  std::vector<double> objective_share;  ///< by interval
  /// By interval, about what the objective gains because bounds of states, and path rows of states
  /// and time alone, are violated between the points: the largest violation times the multipliers
  /// at the interval's points. This happens where a state touches, reaches or leaves a bound
  /// between points; re-integration does not show it.
  std::vector<double> bound_share;
  double objective_size = 0;  ///< magnitude of the objective and of all parts of its integral,
                              ///< or what the solver takes for 0
};

/// `tolerance` is the integrator's, relative and, in units of each state's scale, absolute. A state
/// that cannot be integrated to an interval's end (blow-up, NaN) has an infinite error.
ErrorEstimate estimate_errors(const Problem& problem, const Solution& solution,
                              double tolerance = 1e-12);

/// For each interval, how much of a control its polynomial cannot follow, such as a jump or kink
/// within the interval. It is large if the polynomial fits those of both neighbours badly: (h /
/// T)^2 times the gap in value, slope and curvature at the better of its two ends, over the
/// control's range (at least a tenth of its largest magnitude). For a single interval: its
/// polynomial's last coefficients over that range. The cost's error falls as fast as this number.
std::vector<double> unresolved_controls(const Problem& problem, const Solution& solution);

/// The largest violation of a bound of a state or control or of a path constraint.
struct Violation {
  double value = 0;  ///< in the constraint's unit; 0: none is violated
  std::string constraint;
  double time = 0;
};

/// Checks the scheme's polynomials at `samples` equal steps of each interval and at the nodes.
Violation largest_violation(const Problem& problem, const Solution& solution, int samples = 20);

/// H = L + costate' f at the mesh nodes [cost per time unit], with the sign of Solution::costates.
/// It is constant along an optimum of a problem that does not depend on time, and 0 if tf is free
/// and costs nothing.
std::vector<double> hamiltonian(const Problem& problem, const Solution& solution);

}  // namespace slalom::ocp
