#pragma once

#include <span>
#include <vector>

#include "slalom/kkt/system.hpp"
#include "slalom/nlp/problem.hpp"
#include "slalom/nlp/solver.hpp"

namespace slalom::nlp::ipm {

/// A point of the primal-dual method. Each inequality row has a slack s of its own.
struct Iterate {
  std::vector<double> x, s;    ///< variables; slacks by row (equations: unused)
  std::vector<double> y;       ///< multipliers of the rows
  std::vector<double> zl, zu;  ///< of the variables' bounds, >= 0
  std::vector<double> vl, vu;  ///< of the slacks' bounds, >= 0
  std::vector<double> p, n;    ///< elastic parts of the rows, >= 0; empty unless elastic
  std::vector<double> zp, zn;  ///< their multipliers

  void resize(std::size_t variables, std::size_t rows, bool elastic = false);
};

/// What the restoration phase minimises in place of f (Waechter & Biegler 2006, eq. 30):
///   rho sum(p + n) + zeta/2 sum (D_i (x_i - reference_i))^2, rows relaxed by -p + n.
struct Elastic {
  double rho = 1000, zeta = 0;
  std::vector<double> reference, weight;  ///< weight: D_i^2
};

/// The problem as the method sees it,
///
///   min f(x)   s.t.   g_E(x) = gl,   g_I(x) - s = 0,   xl <= x <= xu,   gl <= s <= gu,
///
/// with its barrier function (Waechter & Biegler 2006, eq. 3) and the residuals of its
/// primal-dual equations (eq. 4, 5).
class Model {
 public:
  explicit Model(Problem& problem);
  /// The same problem with elastic rows; `elastic` must outlive the model.
  Model(Problem& problem, const Elastic& elastic);

  Problem& problem() { return problem_; }
  const Structure& shape() const { return shape_; }
  const Limits& limits() const { return limits_; }
  std::size_t variables() const { return shape_.variables; }
  std::size_t rows() const { return shape_.rows; }
  bool equation(std::size_t r) const { return equation_[r]; }
  bool fixed(std::size_t i) const { return fixed_[i]; }
  const Elastic* elastic() const { return elastic_; }
  /// Second derivative of the proximity term, 0 unless elastic.
  double proximity(std::size_t i) const {
    return elastic_ ? elastic_->zeta * elastic_->weight[i] : 0;
  }
  kkt::Pattern pattern() const;

  /// Evaluates at x; false when a function gave a number that is not finite (see fault()).
  bool values(const Iterate& at, Evaluation& out);
  bool derivatives(const Iterate& at, Evaluation& out);
  bool hessian(const Iterate& at, Evaluation& out);
  const Fault& fault() const { return fault_; }

  /// Row residuals: g - gl of an equation, g - s of an inequality; less p - n if elastic.
  double residual(std::size_t r, const Evaluation& e, const Iterate& at) const {
    return e.rows[r] - (equation_[r] ? limits_.gl[r] : at.s[r]) -
           (elastic_ ? at.p[r] - at.n[r] : 0);
  }
  /// 1-norm of the row residuals.
  double violation(const Evaluation& e, const Iterate& at) const;
  /// f - mu sum of logs; infinity outside the bounds.
  double barrier(const Evaluation& e, const Iterate& at, double mu) const;

  /// Largest residuals of the primal-dual equations at mu.
  struct Residuals {
    double dual = 0, primal = 0, complementarity = 0;  ///< complementarity: largest |s z - mu|
    double centrality = 0;                             ///< largest |s z / mu - 1|
  };
  Residuals residuals(const Evaluation& e, const Iterate& at, double mu) const;

 private:
  bool evaluate(const Iterate& at, Parts parts, Evaluation& out);
  void replace_objective(const Iterate& at, Parts parts, Evaluation& out) const;

  Problem& problem_;
  const Structure& shape_;
  const Limits& limits_;
  std::vector<char> equation_, fixed_;
  Fault fault_;
  const Elastic* elastic_ = nullptr;
};

}  // namespace slalom::nlp::ipm
