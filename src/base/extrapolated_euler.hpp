#pragma once

// Needs Boost's headers (odeint).

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_step_result.hpp>
#include <cmath>
#include <cstddef>

#include "lu.hpp"

namespace slalom {

/// A controlled stepper, as odeint's are, for stiff equations: the linearly implicit Euler method
/// in 1 to kMost steps, extrapolated (P. Deuflhard, E. Hairer and J. Zugck, "One-step and
/// extrapolation methods for differential-algebraic systems", Numer. Math. 51, 1987; E. Hairer and
/// G. Wanner, Solving Ordinary Differential Equations II, section IV.9). Of order kMost, its error
/// judged by the order before. Boost 1.74's own stiff steppers do not compile as C++20.
template <std::size_t N>
class ExtrapolatedEuler {
 public:
  using State = std::array<double, N>;

  /// Absolute and relative error of each step.
  explicit ExtrapolatedEuler(double tolerance) : tolerance_(tolerance) {}

  /// system(x, x', t) sets x', and system.jacobian(x, t) is that of x' by x. On success x and t are
  /// a step on, and `step` is what is to be tried next; else x and t are as they were, and `step`
  /// is shorter. A step into NaN succeeds, for integrate() to see.
  template <class System>
  boost::numeric::odeint::controlled_step_result try_step(const System& system, State& x, double& t,
                                                          double& step) const {
    const Square<N> jacobian = system.jacobian(x, t);
    std::array<State, kMost> before, row;  // of the tableau
    for (std::size_t j = 0; j < kMost; ++j) {
      row[0] = by_euler(system, jacobian, x, t, step, j + 1);
      for (std::size_t k = 0; k < j; ++k) {
        const double ratio = static_cast<double>(j + 1) / static_cast<double>(j - k);
        for (std::size_t i = 0; i < N; ++i)
          row[k + 1][i] = row[k][i] + (row[k][i] - before[k][i]) / (ratio - 1);
      }
      before = row;
    }
    const State &best = row[kMost - 1], &other = row[kMost - 2];
    double error = 0;
    for (std::size_t i = 0; i < N; ++i)
      error = std::max(error, std::fabs(best[i] - other[i]) / (1 + std::fabs(x[i])) / tolerance_);
    const double tried = step;
    const double share = kSafety * std::pow(std::max(error, kLeastError), -1. / kMost);
    step *= std::clamp(share, kShortest, kLongest);
    if (error > 1) return boost::numeric::odeint::fail;
    x = best;
    t += tried;
    return boost::numeric::odeint::success;
  }

 private:
  template <class System>
  static State by_euler(const System& system, const Square<N>& jacobian, State x, double t,
                        double step, std::size_t parts) {
    const double h = step / static_cast<double>(parts);
    Square<N> matrix;
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j) matrix[i][j] = (i == j ? 1 : 0) - h * jacobian[i][j];
    const Lu<N> lu(matrix);
    State slope;
    for (std::size_t part = 1; part <= parts; ++part) {
      system(x, slope, t + h * static_cast<double>(part));
      std::array<std::array<double, 1>, N> change;
      for (std::size_t i = 0; i < N; ++i) change[i][0] = h * slope[i];
      lu.solve(change);
      for (std::size_t i = 0; i < N; ++i) x[i] += change[i][0];
    }
    return x;
  }

  static constexpr std::size_t kMost = 7;
  /// Steps change to this share of what would just do, and within these factors.
  static constexpr double kSafety = 0.8, kShortest = 0.1, kLongest = 4, kLeastError = 1e-12;

  double tolerance_;
};

}  // namespace slalom
