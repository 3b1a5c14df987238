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
/// Interior points (all but the first and last) have states and controls of their own. In
/// compressed form they have only controls; their states are Hermite's interpolant of the ends.
struct Scheme {
  std::string name;
  int order = 0;                           ///< of the states at the breakpoints
  std::vector<double> points;              ///< c_j
  std::vector<std::vector<double>> state;  ///< one row for each defect
  std::vector<std::vector<double>> rate;
  std::vector<double> weight;
  bool compressed = false;

  std::size_t interior() const { return points.size() - 2; }
  std::size_t defects() const { return state.size(); }
  /// Whether the defects use the rates at point j, so that the states' polynomial satisfies the
  /// dynamics there.
  bool collocates(std::size_t j) const;
};

/// Trapezoidal rule, order 2 (Betts 2010, section 4.5; the paper's scheme).
const Scheme& trapezoidal();
/// Hermite-Simpson in separated form, order 4 (Betts 2010, section 4.5; Kelly 2017, eq. 4.3 and
/// 4.4): the midpoint's state is a variable tied by Hermite's interpolant.
const Scheme& hermite_simpson();
/// Hermite-Simpson in compressed form (ibid.; Kelly 2017, eq. 4.5): the midpoint's state is
/// inserted into Simpson's rule, which leaves one defect in each interval. Path rows hold at the
/// midpoint too.
Scheme hermite_simpson_compressed();
/// Implicit Euler, order 1: x_1 - x_0 - h f_1.
Scheme backward_euler();
/// Legendre-Gauss-Radau collocation at n >= 1 points, which include the interval's start but not
/// its end, in integration form: x_i - x_0 - h sum_j A_ij f_j (Garg et al., Automatica 46(11),
/// 2010, section 4.2). Order 2 n - 1.
Scheme lgr(int n);
/// The same points and polynomial in differentiation form: sum_j D_ij x_j - h f_i (ibid., section
/// 4.1).
Scheme lgr_differential(int n);
/// Flipped Radau points, which include the interval's end but not its start, in integration form
/// (Radau IIA; Hairer & Wanner 1996, section IV.5). The end of the horizon is collocated, its start
/// is not; n = 1 is backward Euler. Order 2 n - 1.
Scheme lgr_flipped(int n);
/// Legendre-Gauss-Lobatto collocation at n >= 2 points, which include both ends, in integration
/// form (Lobatto IIIA; Hairer, Norsett & Wanner 1993, section II.7). Order 2 n - 2; n = 2 is the
/// trapezoidal rule, n = 3 Hermite-Simpson's.
Scheme lgl(int n);

/// The names of all schemes.
const std::vector<std::string>& scheme_names();
/// Whether the scheme of that name has any number of points.
bool has_choice_of_points(const std::string& name);
/// The scheme of that name; `points` is for schemes that have a choice. Throws InvalidValue for
/// another name, naming the nearest.
Scheme scheme(const std::string& name, int points = 4);

/// The scheme of each interval of a mesh: one scheme for all intervals, or one for each, such as
/// LGR of different degrees.
class Schemes {
 public:
  Schemes(const Scheme& scheme) : list_{scheme} {}  // NOLINT(google-explicit-constructor)
  /// Throws InvalidValue for an empty list.
  explicit Schemes(std::vector<Scheme> list);

  /// Throws InvalidValue unless it has one scheme, or as many as the mesh has intervals.
  void check(const Mesh& mesh) const;
  const Scheme& of(std::size_t interval) const {
    return list_.size() == 1 ? list_.front() : list_[interval];
  }
  std::size_t most_points() const;

 private:
  std::vector<Scheme> list_;
};

}  // namespace slalom::ocp
