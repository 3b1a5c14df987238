#pragma once

#include <string>
#include <vector>

#include "slalom/base/options.hpp"

namespace slalom::ocp {

/// Breakpoints of the mesh in normalised time tau, from 0 to 1, strictly increasing.
class Mesh {
 public:
  /// N equal intervals; throws InvalidValue for N < 1.
  static Mesh uniform(int intervals);
  /// Any breakpoints; throws InvalidValue unless they increase from 0 to 1.
  explicit Mesh(std::vector<double> breakpoints);

  std::size_t intervals() const { return breakpoints_.size() - 1; }
  const std::vector<double>& breakpoints() const { return breakpoints_; }

 private:
  std::vector<double> breakpoints_;
};

/// A collocation scheme as a table. On an interval of length h with points c_0 = 0 < ... < c_s = 1
/// its defects and quadrature are linear in the states and rates at the points:
///
///   sum_j state[i][j] x_j - h sum_j rate[i][j] f_j = 0,     integral of L = h sum_j weight[j] L_j
///
/// Interior points (all but the first and last) carry states and controls of their own.
struct Scheme {
  std::string name;
  int order = 0;                           ///< of the states at the breakpoints
  std::vector<double> points;              ///< c_j
  std::vector<std::vector<double>> state;  ///< one row a defect
  std::vector<std::vector<double>> rate;
  std::vector<double> weight;

  std::size_t interior() const { return points.size() - 2; }
  std::size_t defects() const { return state.size(); }
};

/// Trapezoidal rule, order 2 (Betts 2010, section 4.5; the paper's scheme).
const Scheme& trapezoidal();
/// Hermite-Simpson in separated form, order 4 (Betts 2010, section 4.5; Kelly 2017, eq. 4.3 and
/// 4.4): the midpoint's state is a variable tied by Hermite's interpolant.
const Scheme& hermite_simpson();

}  // namespace slalom::ocp
