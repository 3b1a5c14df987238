#pragma once

#include <vector>

namespace slalom::ocp {

/// Increasing points on [-1, 1] and weights: the integral of f is the sum of weight * f(point).
struct Quadrature {
  std::vector<double> points, weights;
};

/// Legendre-Gauss rule of n >= 1 points, exact to degree 2 n - 1.
Quadrature legendre_gauss(int n);
/// Legendre-Gauss-Radau rule of n >= 1 points, the first of them -1, exact to degree 2 n - 2.
Quadrature legendre_gauss_radau(int n);
/// Legendre-Gauss-Lobatto rule of n >= 2 points, including both ends, exact to degree 2 n - 3.
Quadrature legendre_gauss_lobatto(int n);

/// Lagrange interpolation through given points, in barycentric form (Berrut & Trefethen, SIAM Rev.
/// 46(3), 2004).
class Interpolation {
 public:
  /// Throws InvalidValue unless there is at least one point and all are distinct.
  explicit Interpolation(std::vector<double> points);

  /// Value of each basis polynomial at x: 1 at its own point, 0 at the others.
  std::vector<double> basis(double x) const;
  /// D[i][j]: derivative of basis polynomial j at point i.
  std::vector<std::vector<double>> differentiation() const;
  /// Integral of each basis polynomial from `from` to `to`.
  std::vector<double> integrals(double from, double to) const;

  const std::vector<double>& points() const { return points_; }

 private:
  std::vector<double> points_, weights_;
};

}  // namespace slalom::ocp
