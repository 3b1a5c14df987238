#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slalom::nlp::ipm {

void Iterate::resize(std::size_t variables, std::size_t rows, bool elastic) {
  for (auto* list : {&p, &n, &zp, &zn}) list->assign(elastic ? rows : 0, 0.0);
  for (auto* list : {&x, &zl, &zu}) list->assign(variables, 0.0);
  for (auto* list : {&s, &y, &vl, &vu}) list->assign(rows, 0.0);
}

Model::Model(Problem& problem)
    : problem_(problem), shape_(problem.structure()), limits_(problem.limits()) {
  for (std::size_t i = 0; i < variables(); ++i) fixed_.push_back(limits_.xl[i] == limits_.xu[i]);
  for (std::size_t r = 0; r < rows(); ++r) equation_.push_back(limits_.gl[r] == limits_.gu[r]);
}

Model::Model(Problem& problem, const Elastic& elastic) : Model(problem) {
  elastic_ = &elastic;
}

kkt::Pattern Model::pattern() const {
  kkt::Pattern pattern;
  pattern.stage_begin = shape_.stage_begin;
  pattern.variables = variables();
  pattern.fixed = fixed_;
  pattern.equation = equation_;
  pattern.row_stage = shape_.row_stage;
  for (auto coupling : shape_.coupling) pattern.border.push_back(coupling == Coupling::border);
  pattern.row_begin = shape_.jacobian_row_begin;
  pattern.col = shape_.jacobian_col;
  pattern.hessian_row = shape_.hessian_row;
  pattern.hessian_col = shape_.hessian_col;
  return pattern;
}

bool Model::evaluate(const Iterate& at, Parts parts, Evaluation& out) {
  fault_ = problem_.evaluate(at.x, elastic_ ? 0 : 1, at.y, parts, out);
  if (elastic_) replace_objective(at, parts, out);
  return !fault_;
}

void Model::replace_objective(const Iterate& at, Parts parts, Evaluation& out) const {
  if (parts.values) {
    out.objective = 0;
    for (std::size_t r = 0; r < rows(); ++r) out.objective += elastic_->rho * (at.p[r] + at.n[r]);
    for (std::size_t i = 0; i < variables(); ++i) {
      const double away = at.x[i] - elastic_->reference[i];
      out.objective += 0.5 * proximity(i) * away * away;
    }
  }
  if (parts.derivatives)
    for (std::size_t i = 0; i < variables(); ++i)
      out.gradient[i] = proximity(i) * (at.x[i] - elastic_->reference[i]);
}

bool Model::values(const Iterate& at, Evaluation& out) {
  return evaluate(at, {.values = true}, out);
}
bool Model::derivatives(const Iterate& at, Evaluation& out) {
  return evaluate(at, {.values = true, .derivatives = true}, out);
}
bool Model::hessian(const Iterate& at, Evaluation& out) {
  return evaluate(at, {.hessian = true}, out);
}

double Model::violation(const Evaluation& e, const Iterate& at) const {
  double sum = 0;
  for (std::size_t r = 0; r < rows(); ++r) sum += std::fabs(residual(r, e, at));
  return sum;
}

double Model::barrier(const Evaluation& e, const Iterate& at, double mu) const {
  double product = 1, logs = 0;
  bool inside = true;
  // Logs of products: one log for many slacks, as long as the product stays in range.
  const auto side = [&](double slack) {
    inside = inside && slack > 0;
    product *= slack;
    if (product > 1e100 || product < 1e-100) {
      logs += std::log(product);
      product = 1;
    }
  };
  for (std::size_t i = 0; i < variables(); ++i) {
    if (fixed_[i]) continue;
    if (std::isfinite(limits_.xl[i])) side(at.x[i] - limits_.xl[i]);
    if (std::isfinite(limits_.xu[i])) side(limits_.xu[i] - at.x[i]);
  }
  for (std::size_t r = 0; r < rows(); ++r) {
    if (equation_[r]) continue;
    if (std::isfinite(limits_.gl[r])) side(at.s[r] - limits_.gl[r]);
    if (std::isfinite(limits_.gu[r])) side(limits_.gu[r] - at.s[r]);
  }
  for (std::size_t r = 0; r < at.p.size(); ++r) {
    side(at.p[r]);
    side(at.n[r]);
  }
  if (!inside) return std::numeric_limits<double>::infinity();
  return e.objective - mu * (logs + std::log(product));
}

Model::Residuals Model::residuals(const Evaluation& e, const Iterate& at, double mu) const {
  Residuals result;
  const auto pair = [&](double slack, double z) {
    result.complementarity = std::max(result.complementarity, std::fabs(slack * z - mu));
    if (mu > 0) result.centrality = std::max(result.centrality, std::fabs(slack * z / mu - 1));
  };
  static thread_local std::vector<double> slope;
  slope.assign(e.gradient.begin(), e.gradient.end());
  for (std::size_t r = 0; r < rows(); ++r) {
    for (auto k = shape_.jacobian_row_begin[r]; k < shape_.jacobian_row_begin[r + 1]; ++k)
      slope[shape_.jacobian_col[k]] += at.y[r] * e.jacobian[k];
    result.primal = std::max(result.primal, std::fabs(residual(r, e, at)));
    if (elastic_) {
      result.dual = std::max({result.dual, std::fabs(elastic_->rho - at.y[r] - at.zp[r]),
                              std::fabs(elastic_->rho + at.y[r] - at.zn[r])});
      pair(at.p[r], at.zp[r]);
      pair(at.n[r], at.zn[r]);
    }
    if (equation_[r]) continue;
    result.dual = std::max(result.dual, std::fabs(-at.y[r] - at.vl[r] + at.vu[r]));
    if (std::isfinite(limits_.gl[r])) pair(at.s[r] - limits_.gl[r], at.vl[r]);
    if (std::isfinite(limits_.gu[r])) pair(limits_.gu[r] - at.s[r], at.vu[r]);
  }
  for (std::size_t i = 0; i < variables(); ++i) {
    if (fixed_[i]) continue;
    result.dual = std::max(result.dual, std::fabs(slope[i] - at.zl[i] + at.zu[i]));
    if (std::isfinite(limits_.xl[i])) pair(at.x[i] - limits_.xl[i], at.zl[i]);
    if (std::isfinite(limits_.xu[i])) pair(limits_.xu[i] - at.x[i], at.zu[i]);
  }
  return result;
}

}  // namespace slalom::nlp::ipm
