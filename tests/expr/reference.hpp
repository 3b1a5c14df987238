#pragma once

// Independent of the code under test: evaluates expressions node by node with std::'s functions, in
// plain or complex numbers, and differentiates by complex step.

#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "slalom/expr/derivative_check.hpp"
#include "slalom/expr/expr.hpp"
#include "slalom/expr/function.hpp"

namespace slalom::expr::reference {

using Complex = std::complex<double>;

inline double real(double v) {
  return v;
}
inline double real(const Complex& v) {
  return v.real();
}

template <class T>
T power(const T& a, const T& b) {
  const double n = real(b);
  if (b == T(n) && n == std::floor(n) && std::fabs(n) < 100) {
    T result = 1;
    for (int i = 0; i < std::abs(static_cast<int>(n)); ++i) result *= a;
    return n < 0 ? T(1) / result : result;
  }
  return std::exp(b * std::log(a));
}

inline double arc_tangent(double y, double x) {
  return std::atan2(y, x);
}
inline Complex arc_tangent(const Complex& y, const Complex& x) {  // to first order in the imaginary
  const double yr = y.real(), xr = x.real();
  return {std::atan2(yr, xr), (xr * y.imag() - yr * x.imag()) / (xr * xr + yr * yr)};
}

template <class T>
T apply(Op op, const T& a, const T& b, const T& c) {
  switch (op) {
    case Op::neg:
      return -a;
    case Op::square:
      return a * a;
    case Op::sqrt:
      return std::sqrt(a);
    case Op::exp:
      return std::exp(a);
    case Op::log:
      return std::log(a);
    case Op::sin:
      return std::sin(a);
    case Op::cos:
      return std::cos(a);
    case Op::tan:
      return std::tan(a);
    case Op::asin:
      return std::asin(a);
    case Op::acos:
      return std::acos(a);
    case Op::atan:
      return std::atan(a);
    case Op::sinh:
      return std::sinh(a);
    case Op::cosh:
      return std::cosh(a);
    case Op::tanh:
      return std::tanh(a);
    case Op::abs:
      return real(a) < 0 ? -a : a;
    case Op::sign:
      return T((real(a) > 0) - (real(a) < 0));
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      return a / b;
    case Op::pow:
      return power(a, b);
    case Op::atan2:
      return arc_tangent(a, b);
    case Op::min:
      return real(a) < real(b) ? a : b;
    case Op::max:
      return real(a) > real(b) ? a : b;
    case Op::select:
      return real(a) > 0 ? b : c;
    default:
      throw std::logic_error("not an operation");
  }
}

template <class T>
T evaluate(const Node* node, std::map<const Node*, T>& known) {
  if (const auto it = known.find(node); it != known.end()) return it->second;
  T result;
  if (node->op() == Op::constant) {
    result = node->value();
  } else {
    T arg[3] = {};
    for (std::size_t i = 0; i < node->args().size(); ++i)
      arg[i] = evaluate(node->args()[i].node(), known);
    result = apply(node->op(), arg[0], arg[1], arg[2]);
  }
  known.emplace(node, result);
  return result;
}

template <class T>
std::vector<T> values(const std::vector<Expr>& outputs, const std::vector<Expr>& symbols,
                      const std::vector<T>& x) {
  std::map<const Node*, T> known;
  for (std::size_t i = 0; i < symbols.size(); ++i) known.emplace(symbols[i].node(), x[i]);
  std::vector<T> result;
  for (const auto& output : outputs) result.push_back(evaluate(output.node(), known));
  return result;
}

/// Full Jacobian, row by row, by complex step: exact to rounding.
inline std::vector<double> jacobian(const std::vector<Expr>& outputs,
                                    const std::vector<Expr>& symbols,
                                    const std::vector<double>& x) {
  constexpr double step = 1e-30;
  std::vector<double> result(outputs.size() * x.size());
  for (std::size_t col = 0; col < x.size(); ++col) {
    std::vector<Complex> z(x.begin(), x.end());
    z[col] += Complex(0, step);
    const auto f = values(outputs, symbols, z);
    for (std::size_t row = 0; row < outputs.size(); ++row)
      result[row * x.size() + col] = f[row].imag() / step;
  }
  return result;
}

/// A Function's derivatives at one point as full matrices, row by row.
inline std::vector<double> full_jacobian(const Function& f, const std::vector<double>& x) {
  std::vector<double> entries(f.jacobian_pattern().size()), full(f.outputs() * x.size(), 0);
  f.evaluate(1, x, {}, {}, {.values = false, .jacobian = true}, {}, entries, {});
  for (std::size_t k = 0; k < entries.size(); ++k)
    full[f.jacobian_pattern()[k].row * x.size() + f.jacobian_pattern()[k].col] = entries[k];
  return full;
}

inline std::vector<double> full_hessian(const Function& f, const std::vector<double>& x,
                                        const std::vector<double>& weights) {
  std::vector<double> entries(f.hessian_pattern().size()), full(x.size() * x.size(), 0);
  f.evaluate(1, x, {}, weights, {.values = false, .hessian = true}, {}, {}, entries);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto [row, col] = f.hessian_pattern()[k];
    full[row * x.size() + col] = full[col * x.size() + row] = entries[k];
  }
  return full;
}

/// Compares a Function's Jacobian with the complex step and its Hessian with differences of the
/// complex step's weighted gradient; the largest relative error of all entries.
inline double derivative_error(const std::vector<Expr>& outputs, const std::vector<Expr>& symbols,
                               const std::vector<double>& x, const std::vector<double>& weights,
                               double* jacobian_error = nullptr) {
  const Function f(symbols, {}, outputs);
  const auto stated = full_jacobian(f, x), exact = jacobian(outputs, symbols, x);
  double worst = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const double scale = std::max({std::fabs(exact[k]), std::fabs(stated[k]), 1e-4});
    const double error = std::fabs(stated[k] - exact[k]) / scale;
    if (!(error <= worst)) worst = error;  // NaN too
  }
  if (jacobian_error != nullptr) *jacobian_error = worst;
  StatedDerivatives hessian;
  hessian.variables = hessian.outputs = x.size();
  for (std::size_t k = 0; k < x.size() * x.size(); ++k)
    hessian.jacobian_pattern.push_back({k / x.size(), k % x.size()});
  hessian.values = [&](std::span<const double> at, std::span<double> gradient) {
    const auto full = jacobian(outputs, symbols, {at.begin(), at.end()});
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (std::size_t k = 0; k < full.size(); ++k)
      gradient[k % x.size()] += weights[k / x.size()] * full[k];
  };
  hessian.jacobian = [&](std::span<const double> at, std::span<double> entries) {
    const auto full = full_hessian(f, {at.begin(), at.end()}, weights);
    std::copy(full.begin(), full.end(), entries.begin());
  };
  const double hessian_error = check_derivatives(hessian, {x}).jacobian.error;
  return std::max(worst, hessian_error);
}

/// Distance of two numbers in units in the last place; 0 for two NaNs, huge for one.
inline double ulps(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b) ? 0 : 1e300;
  if (a == b) return 0;
  const double larger = std::max(std::fabs(a), std::fabs(b));
  return std::fabs(a - b) / (std::nextafter(larger, 2 * larger + 1) - larger);
}

}  // namespace slalom::expr::reference
