#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "slalom/nlp/problem.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp {

inline constexpr double kInf = std::numeric_limits<double>::infinity();
using Vector = std::vector<double>;

/// Whether a back end stops at a barrier floor; one that does not refuses it.
inline bool stops_at_floor(const std::string& backend) {
  return backend != "knitro";
}

/// A problem written by hand: functions with dense first and second derivatives.
class SmallProblem : public Problem {
 public:
  using Function = std::function<Vector(const Vector&)>;

  std::function<double(const Vector&)> objective;
  Function gradient;
  Function rows = [](const Vector&) { return Vector{}; };
  Function jacobian = [](const Vector&) { return Vector{}; };  ///< row by row
  /// Lower triangle of sigma f'' + sum y g'', row by row.
  std::function<Vector(const Vector&, double sigma, const Vector& y)> hessian;
  std::function<Fault(const Vector&)> fault = [](const Vector&) { return Fault{}; };
  Vector start;
  Limits bounds;
  std::uint64_t id = 0;  ///< of the structure: solvers keep their workspace for the same one
  int evaluations = 0;

  /// Fills the structure; variables and rows may be scaled as a transcription scales them: the
  /// functions above keep the user's units, the bounds too.
  void finish(Vector variable_scale = {}, Vector row_scale = {}) {
    const std::size_t n = bounds.xl.size(), m = bounds.gl.size();
    variable_scale.resize(n, 1.0);
    row_scale.resize(m, 1.0);
    shape_ = {};
    shape_.id = id;
    shape_.variables = n;
    shape_.rows = m;
    shape_.stages = 1;
    shape_.variable_stage.assign(n, 0);
    shape_.row_stage.assign(m, 0);
    for (std::size_t e = 0; e < m * n; ++e) {
      shape_.jacobian_row.push_back(static_cast<std::uint32_t>(e / n));
      shape_.jacobian_col.push_back(static_cast<std::uint32_t>(e % n));
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        shape_.hessian_row.push_back(static_cast<std::uint32_t>(i));
        shape_.hessian_col.push_back(static_cast<std::uint32_t>(j));
      }
    shape_.variable_scale = std::move(variable_scale);
    shape_.row_scale = std::move(row_scale);
    limits_ = bounds;
    for (std::size_t i = 0; i < n; ++i) {
      limits_.xl[i] /= shape_.variable_scale[i];
      limits_.xu[i] /= shape_.variable_scale[i];
    }
    for (std::size_t r = 0; r < m; ++r) {
      limits_.gl[r] *= shape_.row_scale[r];
      limits_.gu[r] *= shape_.row_scale[r];
    }
  }

  Start cold_start() const {
    Start result{start, {}, {}, {}};
    for (std::size_t i = 0; i < start.size(); ++i) result.x[i] /= shape_.variable_scale[i];
    return result;
  }

  const Structure& structure() const override { return shape_; }
  const Limits& limits() const override { return limits_; }

  Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y, Parts parts,
                 Evaluation& out) override {
    ++evaluations;
    const Vector& scale = shape_.variable_scale;
    Vector user(x.begin(), x.end());
    for (std::size_t i = 0; i < user.size(); ++i) user[i] *= scale[i];
    if (const Fault found = fault(user)) return found;
    const std::size_t n = user.size();
    if (parts.values) {
      out.objective = objective(user);
      out.rows = rows(user);
      for (std::size_t r = 0; r < out.rows.size(); ++r) out.rows[r] *= shape_.row_scale[r];
    }
    if (parts.derivatives) {
      out.gradient = gradient(user);
      for (std::size_t i = 0; i < n; ++i) out.gradient[i] *= scale[i];
      out.jacobian = jacobian(user);
      for (std::size_t e = 0; e < out.jacobian.size(); ++e)
        out.jacobian[e] *= shape_.row_scale[e / n] * scale[e % n];
    }
    if (parts.hessian) {
      Vector weights(y.begin(), y.end());
      for (std::size_t r = 0; r < weights.size(); ++r) weights[r] *= shape_.row_scale[r];
      out.hessian = hessian(user, sigma, weights);
      for (std::size_t e = 0; e < out.hessian.size(); ++e)
        out.hessian[e] *= scale[shape_.hessian_row[e]] * scale[shape_.hessian_col[e]];
    }
    return {};
  }
  std::string variable_name(std::size_t i) const override { return "x" + std::to_string(i + 1); }
  std::string row_name(std::size_t i) const override { return "row " + std::to_string(i + 1); }

 private:
  Structure shape_;
  Limits limits_;
};

/// Hock and Schittkowski, problem 71: f = 17.0140173 at (1, 4.7429994, 3.8211503, 1.3794082).
inline SmallProblem hs071(Vector variable_scale = {}, Vector row_scale = {}) {
  SmallProblem p;
  p.objective = [](const Vector& x) { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; };
  p.gradient = [](const Vector& x) {
    return Vector{x[3] * (2 * x[0] + x[1] + x[2]), x[0] * x[3], x[0] * x[3] + 1,
                  x[0] * (x[0] + x[1] + x[2])};
  };
  p.rows = [](const Vector& x) {
    return Vector{x[0] * x[1] * x[2] * x[3], x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]};
  };
  p.jacobian = [](const Vector& x) {
    return Vector{x[1] * x[2] * x[3], x[0] * x[2] * x[3], x[0] * x[1] * x[3], x[0] * x[1] * x[2],
                  2 * x[0],           2 * x[1],           2 * x[2],           2 * x[3]};
  };
  p.hessian = [](const Vector& x, double s, const Vector& y) {
    return Vector{s * 2 * x[3] + 2 * y[1],
                  s * x[3] + y[0] * x[2] * x[3],
                  2 * y[1],
                  s * x[3] + y[0] * x[1] * x[3],
                  y[0] * x[0] * x[3],
                  2 * y[1],
                  s * (2 * x[0] + x[1] + x[2]) + y[0] * x[1] * x[2],
                  s * x[0] + y[0] * x[0] * x[2],
                  s * x[0] + y[0] * x[0] * x[1],
                  2 * y[1]};
  };
  p.bounds = {{1, 1, 1, 1}, {5, 5, 5, 5}, {25, 40}, {kInf, 40}};
  p.start = {1, 5, 5, 1};
  p.finish(std::move(variable_scale), std::move(row_scale));
  return p;
}

/// min c x + q/2 x^2 over one variable, with a row k x when `row` has a finite side.
inline SmallProblem one_variable(double c, double q, double lower, double upper, double x0,
                                 double k = 0, double row_lower = -kInf, double row_upper = kInf) {
  SmallProblem p;
  p.objective = [=](const Vector& x) { return c * x[0] + 0.5 * q * x[0] * x[0]; };
  p.gradient = [=](const Vector& x) { return Vector{c + q * x[0]}; };
  p.hessian = [=](const Vector&, double s, const Vector&) { return Vector{s * q}; };
  p.bounds = {{lower}, {upper}, {}, {}};
  if (std::isfinite(row_lower) || std::isfinite(row_upper)) {
    p.rows = [=](const Vector& x) { return Vector{k * x[0]}; };
    p.jacobian = [=](const Vector&) { return Vector{k}; };
    p.bounds.gl = {row_lower};
    p.bounds.gu = {row_upper};
  }
  p.start = {x0};
  p.finish();
  return p;
}

}  // namespace slalom::nlp
