#include "slalom/ocp/quadrature.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

constexpr int kMostSteps = 100;

void check_count(const char* rule, int n, int least) {
  if (n < least)
    throw InvalidValue(rule, fmt::format("{} points", n), fmt::format("at least {}", least));
}

/// P_(n-1)(x) and P_n(x) by the three-term recurrence, which is stable on [-1, 1].
std::pair<double, double> legendre(int n, double x) {
  double before = 0, now = 1;
  for (int k = 1; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
    before = now;
    now = next;
  }
  return {before, now};
}

/// Derivative of P_n at |x| < 1.
double slope(int n, double x) {
  const auto [before, now] = legendre(n, x);
  return n * (x * now - before) / (x * x - 1);
}

/// Newton's method from a guess close to the root; `step` gives f / f'.
template <class Step>
double root(double x, Step step) {
  for (int k = 0; k < kMostSteps; ++k) {
    const double change = step(x);
    x -= change;
    if (std::fabs(change) < 1e-16) break;
  }
  return x;
}

}  // namespace

// Guesses and weights: Hildebrand, Introduction to Numerical Analysis, 1974, sections 8.5, 8.11 and
// 8.12; Canuto, Hussaini, Quarteroni & Zang, Spectral Methods, 2006, section 2.3.

Quadrature legendre_gauss(int n) {
  check_count("Legendre-Gauss rule", n, 1);
  Quadrature rule;
  for (int k = 0; k < n; ++k) {
    const double guess = -std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5));
    const double x = 2 * k + 1 == n ? 0 : root(guess, [&](double at) {
      return legendre(n, at).second / slope(n, at);
    });
    rule.points.push_back(x);
    rule.weights.push_back(2 / ((1 - x * x) * slope(n, x) * slope(n, x)));
  }
  return rule;
}

Quadrature legendre_gauss_radau(int n) {
  check_count("Legendre-Gauss-Radau rule", n, 1);
  Quadrature rule{{-1}, {2.0 / (n * n)}};
  for (int k = 1; k < n; ++k) {
    const double guess = -std::cos(2 * std::numbers::pi * k / (2 * n - 1));
    // Roots of (P_(n-1) + P_n) / (1 + x), whose root at -1 is taken out.
    const double x = root(guess, [&](double at) {
      const auto [before, now] = legendre(n, at);
      const double f = before + now, df = slope(n - 1, at) + slope(n, at);
      return f / (df - f / (1 + at));
    });
    const double p = legendre(n, x).first;
    rule.points.push_back(x);
    rule.weights.push_back((1 - x) / (n * p * n * p));
  }
  return rule;
}

Quadrature legendre_gauss_lobatto(int n) {
  check_count("Legendre-Gauss-Lobatto rule", n, 2);
  Quadrature rule;
  const int degree = n - 1;
  for (int k = 0; k < n; ++k) {
    double x = -std::cos(std::numbers::pi * k / degree);
    if (k == 0 || k == degree) {
      x = k == 0 ? -1 : 1;
    } else if (2 * k == degree) {
      x = 0;
    } else {  // roots of P'; P'' from Legendre's equation (1 - x^2) P'' = 2 x P' - n (n + 1) P
      x = root(x, [&](double at) {
        const double p = legendre(degree, at).second, dp = slope(degree, at);
        return dp * (1 - at * at) / (2 * at * dp - degree * (degree + 1) * p);
      });
    }
    const double p = legendre(degree, x).second;
    rule.points.push_back(x);
    rule.weights.push_back(2 / (degree * n * p * p));
  }
  return rule;
}

Interpolation::Interpolation(std::vector<double> points) : points_(std::move(points)) {
  if (points_.empty()) throw InvalidValue("interpolation", "no points", "at least one");
  weights_.assign(points_.size(), 1.0);
  for (std::size_t j = 0; j < points_.size(); ++j)
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (k == j) continue;
      const double distance = points_[j] - points_[k];
      if (distance == 0)
        throw InvalidValue("interpolation", fmt::format("point {} twice", points_[j]),
                           "distinct points");
      weights_[j] /= 2 * distance;  // the factor, common to all, keeps many of them in range
    }
}

std::vector<double> Interpolation::basis(double x) const {
  std::vector<double> values(points_.size(), 0.0);
  double sum = 0;
  for (std::size_t j = 0; j < points_.size(); ++j) {
    if (x == points_[j]) {
      values.assign(points_.size(), 0.0);
      values[j] = 1;
      return values;
    }
    values[j] = weights_[j] / (x - points_[j]);
    sum += values[j];
  }
  for (double& value : values) value /= sum;
  return values;
}

std::vector<std::vector<double>> Interpolation::differentiation() const {
  const std::size_t n = points_.size();
  std::vector<std::vector<double>> d(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      d[i][j] = weights_[j] / weights_[i] / (points_[i] - points_[j]);
      d[i][i] -= d[i][j];  // a constant has no slope
    }
  return d;
}

std::vector<double> Interpolation::integrals(double from, double to) const {
  const Quadrature rule = legendre_gauss(static_cast<int>(points_.size() + 1) / 2);
  const double half = (to - from) / 2, middle = (to + from) / 2;
  std::vector<double> sums(points_.size(), 0.0);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const auto values = basis(middle + half * rule.points[q]);
    for (std::size_t j = 0; j < sums.size(); ++j) sums[j] += half * rule.weights[q] * values[j];
  }
  return sums;
}

}  // namespace slalom::ocp
