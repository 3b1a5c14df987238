#pragma once

#include <string>
#include <utility>
#include <vector>

namespace slalom::ocp {

/// States and controls at the points of a mesh, in the user's units. In a guess, the points may be
/// any increasing taus; values between them are linear.
struct Trajectory {
  double t0 = 0, tf = 1;
  std::vector<double> tau;                    ///< one for each point, 0 ... 1
  std::vector<std::vector<double>> states;    ///< [point][state]
  std::vector<std::vector<double>> controls;  ///< [point][control]
  std::vector<double> static_parameters;
  std::vector<double> slacks;          ///< in the order the problem declared them
  std::vector<double> integrals = {};  ///< in the same order; 0 if a guess leaves them out

  double time(std::size_t point) const { return time_at(tau[point]); }
  double time_at(double at_tau) const { return t0 + at_tau * (tf - t0); }
};

}  // namespace slalom::ocp
