#pragma once

#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nlp/small_problems.hpp"
#include "slalom/expr/expr.hpp"
#include "slalom/expr/function.hpp"

namespace slalom::nlp {

/// Variables counted from 1, as the literature counts them.
class Variables {
 public:
  explicit Variables(std::vector<expr::Expr> list) : list_(std::move(list)) {}
  const expr::Expr& operator[](std::size_t i) const { return list_.at(i - 1); }
  const std::vector<expr::Expr>& list() const { return list_; }

 private:
  std::vector<expr::Expr> list_;
};

/// A nonlinear program stated in expressions; ExpressionProblem turns it into the seam.
class Statement {
 public:
  /// New variables x1, x2, ... with these starting values; free until bounded.
  Variables variables(const Vector& start) {
    std::vector<expr::Expr> fresh;
    for (const double value : start) {
      fresh.push_back(expr::Expr::symbol("x" + std::to_string(variables_.size() + 1)));
      variables_.push_back(fresh.back());
      start_.push_back(value);
      limits_.xl.push_back(-kInf);
      limits_.xu.push_back(kInf);
    }
    return Variables(std::move(fresh));
  }
  Variables variables(std::size_t count, double start) { return variables(Vector(count, start)); }

  /// Lower and upper bounds of all variables: one number for each, or one for all.
  void lower(const Vector& bounds) { limits_.xl = for_all(bounds); }
  void upper(const Vector& bounds) { limits_.xu = for_all(bounds); }

  void minimise(const expr::Expr& objective) { outputs_[0] = objective; }
  /// lower <= value <= upper; without a name, "row 1", "row 2", ...
  void between(double lower, const expr::Expr& value, double upper, const std::string& name = "") {
    outputs_.push_back(value);
    limits_.gl.push_back(lower);
    limits_.gu.push_back(upper);
    row_names_.push_back(name.empty() ? "row " + std::to_string(row_names_.size() + 1) : name);
  }
  void nonnegative(const expr::Expr& value, const std::string& name = "") {
    between(0, value, kInf, name);
  }
  void zero(const expr::Expr& value, const std::string& name = "") { between(0, value, 0, name); }

  std::size_t variable_count() const { return variables_.size(); }
  std::size_t row_count() const { return row_names_.size(); }

 private:
  friend class ExpressionProblem;
  Vector for_all(const Vector& bounds) const {
    return bounds.size() == 1 ? Vector(variables_.size(), bounds[0]) : bounds;
  }

  std::vector<expr::Expr> variables_;
  std::vector<expr::Expr> outputs_{expr::Expr(0)};  ///< objective, then rows
  std::vector<std::string> row_names_;
  Limits limits_;
  Vector start_;
};

/// A Statement behind the seam: one stage, no globals, dense derivatives from the expressions. A
/// value or derivative that is not finite is a fault naming its function (and variable).
class ExpressionProblem final : public SmallProblem {
 public:
  explicit ExpressionProblem(const Statement& statement)
      : row_names_(statement.row_names_),
        formulas_{statement.variables_,
                  statement.outputs_[0],
                  {statement.outputs_.begin() + 1, statement.outputs_.end()}} {
    const auto function = std::make_shared<const expr::Function>(
        statement.variables_, std::vector<expr::Expr>{}, statement.outputs_);
    bounds = statement.limits_;
    start = statement.start_;
    objective = [function](const Vector& x) { return values(*function, x)[0]; };
    rows = [function](const Vector& x) {
      Vector all = values(*function, x);
      all.erase(all.begin());
      return all;
    };
    gradient = [function](const Vector& x) {
      Vector first = dense_jacobian(*function, x);
      first.resize(x.size());
      return first;
    };
    jacobian = [function](const Vector& x) {
      Vector all = dense_jacobian(*function, x);
      all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(x.size()));
      return all;
    };
    hessian = [function](const Vector& x, double sigma, const Vector& y) {
      return dense_hessian(*function, x, sigma, y);
    };
    finish();
  }

  Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y, Parts parts,
                 Evaluation& out) override {
    if (const Fault found = SmallProblem::evaluate(x, sigma, y, parts, out)) return found;
    const std::size_t n = x.size();
    if (parts.values) {
      if (!std::isfinite(out.objective)) return {"objective", "stage 0", ""};
      for (std::size_t r = 0; r < out.rows.size(); ++r)
        if (!std::isfinite(out.rows[r])) return {row_name(r), "stage 0", ""};
    }
    if (parts.derivatives) {
      for (std::size_t i = 0; i < n; ++i)
        if (!std::isfinite(out.gradient[i])) return {"objective", "stage 0", variable_name(i)};
      for (std::size_t e = 0; e < out.jacobian.size(); ++e)
        if (!std::isfinite(out.jacobian[e]))
          return {row_name(e / n), "stage 0", variable_name(e % n)};
    }
    if (parts.hessian)
      for (std::size_t e = 0; e < out.hessian.size(); ++e)
        if (!std::isfinite(out.hessian[e]))
          return {"second derivatives", "stage 0", variable_name(structure().hessian_row[e])};
    return {};
  }
  std::string row_name(std::size_t i) const override { return row_names_.at(i); }
  std::optional<Formulas> formulas() const override { return formulas_; }

 private:
  static Vector values(const expr::Function& f, const Vector& x) {
    Vector result(f.outputs());
    f(x, {}, result);
    return result;
  }
  static Vector dense_jacobian(const expr::Function& f, const Vector& x) {
    Vector result(f.outputs() * x.size()), all(f.outputs()), entries(f.jacobian_pattern().size());
    f.evaluate(1, x, {}, {}, {.values = true, .jacobian = true, .hessian = false}, all, entries,
               {});
    for (std::size_t e = 0; e < entries.size(); ++e)
      result[f.jacobian_pattern()[e].row * x.size() + f.jacobian_pattern()[e].col] = entries[e];
    return result;
  }
  /// Lower triangle of sigma f'' + sum y g'', row by row.
  static Vector dense_hessian(const expr::Function& f, const Vector& x, double sigma,
                              const Vector& y) {
    Vector result(x.size() * (x.size() + 1) / 2), all(f.outputs()),
        entries(f.hessian_pattern().size()), weights{sigma};
    weights.insert(weights.end(), y.begin(), y.end());
    f.evaluate(1, x, {}, weights, {.values = true, .jacobian = false, .hessian = true}, all, {},
               entries);
    for (std::size_t e = 0; e < entries.size(); ++e) {
      const auto [row, col] = f.hessian_pattern()[e];
      result[row * (row + 1) / 2 + col] = entries[e];
    }
    return result;
  }

  std::vector<std::string> row_names_;
  Formulas formulas_;
};

}  // namespace slalom::nlp
