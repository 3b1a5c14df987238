#pragma once

#include <memory>
#include <vector>

#include "slalom/ocp/problem.hpp"
#include "slalom/ocp/scheme.hpp"
#include "slalom/ocp/trajectory.hpp"

namespace slalom::ocp {

/// A trajectory between its points, by the scheme's own polynomials. On each interval the controls
/// interpolate the controls at the collocated points. The states are the states at the interval's
/// start plus the integral of the polynomial through the rates at the collocated points (Hairer,
/// Norsett & Wanner 1993, section II.7). So states are quadratic and controls linear for the
/// trapezoidal rule, cubic and quadratic for Hermite-Simpson, of degree n and n - 1 for LGR and n
/// for LGL with n points; backward Euler holds its control.
class Interpolant {
 public:
  /// `trajectory` must stand at the points of mesh and schemes; throws InvalidValue otherwise.
  Interpolant(const Problem& problem, const Trajectory& trajectory, const Mesh& mesh,
              const Schemes& schemes);
  ~Interpolant();
  Interpolant(Interpolant&&) noexcept;
  Interpolant& operator=(Interpolant&&) noexcept;

  /// At time t, within t0 ... tf; beyond, the values at the nearer end.
  std::vector<double> states(double t) const;
  std::vector<double> controls(double t) const;
  /// At local time c (0 ... 1) of an interval: at a break, the limit from within that interval.
  std::vector<double> states(std::size_t interval, double c) const;
  std::vector<double> controls(std::size_t interval, double c) const;

  /// The trajectory on another mesh, as a guess for it. Everything except states and controls is
  /// kept.
  Trajectory resampled(const Mesh& mesh, const Schemes& schemes) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slalom::ocp
