#include "newton.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::nlp::ipm {
namespace {

constexpr double kFirstDelta = 1e-4, kLeastDelta = 1e-20, kMostDelta = 1e40;
constexpr int kRefinements = 3;

}  // namespace

Newton::Newton(Model& model)
    : model_(model), limits_(model.limits()), backend_(kkt::make_stage_ldlt(model.pattern())) {
  for (std::size_t i = 0; i < model.variables(); ++i) wanted_.positive += model.fixed(i) ? 0 : 1;
  for (std::size_t r = 0; r < model.rows(); ++r) wanted_.negative += model.equation(r) ? 1 : 0;
  for (auto* list : {&sigma_x_, &diagonal_, &r_x_, &a_}) list->resize(model.variables());
  for (auto* list : {&sigma_s_, &row_diagonal_, &r_row_, &r_s_, &b_}) list->resize(model.rows());
  const bool elastic = model.elastic() != nullptr;
  for (auto* list : {&sigma_p_, &sigma_n_, &r_p_, &r_n_}) list->resize(elastic ? model.rows() : 0);
  correction_.resize(model.variables(), model.rows(), elastic);
}

/// What the elastic parts let a row give way for a unit of its multiplier.
double Newton::flexibility(std::size_t r) const {
  return model_.elastic() ? 1 / sigma_p_[r] + 1 / sigma_n_[r] : 0;
}

kkt::Inertia Newton::try_factorize(const Evaluation& e) {
  for (std::size_t i = 0; i < model_.variables(); ++i)
    diagonal_[i] = sigma_x_[i] + model_.proximity(i) + delta_w_;
  for (std::size_t r = 0; r < model_.rows(); ++r)
    row_diagonal_[r] =
        model_.equation(r) ? delta_c_ + flexibility(r) : 1 / (1 / sigma_s_[r] + flexibility(r));
  return backend_->factorize({e.hessian, diagonal_, e.jacobian, row_diagonal_});
}

bool Newton::factorize(const Evaluation& e, const Iterate& at, double mu) {
  for (std::size_t i = 0; i < model_.variables(); ++i) {
    sigma_x_[i] = 0;
    if (model_.fixed(i)) continue;
    if (std::isfinite(limits_.xl[i])) sigma_x_[i] += at.zl[i] / (at.x[i] - limits_.xl[i]);
    if (std::isfinite(limits_.xu[i])) sigma_x_[i] += at.zu[i] / (limits_.xu[i] - at.x[i]);
  }
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    sigma_s_[r] = 0;
    if (model_.equation(r)) continue;
    if (std::isfinite(limits_.gl[r])) sigma_s_[r] += at.vl[r] / (at.s[r] - limits_.gl[r]);
    if (std::isfinite(limits_.gu[r])) sigma_s_[r] += at.vu[r] / (limits_.gu[r] - at.s[r]);
  }
  for (std::size_t r = 0; r < sigma_p_.size(); ++r) {
    sigma_p_[r] = at.zp[r] / at.p[r];
    sigma_n_[r] = at.zn[r] / at.n[r];
  }
  delta_w_ = delta_c_ = 0;
  auto inertia = try_factorize(e);
  if (inertia == wanted_) return true;
  if (inertia.zero > 0) delta_c_ = 1e-8 * std::pow(mu, 0.25);
  delta_w_ = last_delta_w_ == 0 ? kFirstDelta : std::max(kLeastDelta, last_delta_w_ / 3);
  while (delta_w_ < kMostDelta) {
    inertia = try_factorize(e);
    if (inertia == wanted_) {
      last_delta_w_ = delta_w_;
      return true;
    }
    if (inertia.zero > 0) delta_c_ = 1e-8 * std::pow(mu, 0.25);
    delta_w_ *= last_delta_w_ == 0 ? 100 : 8;
  }
  return false;
}

/// From the right-hand sides r to the step:
///   (W + Sx) dx + J' dy = r_x,   J dx - ds - dp + dn = r_row,
///   Ss ds - dy = r_s,   Sp dp - dy = r_p,   Sn dn + dy = r_n,
/// with ds for inequalities and dp, dn for elastic rows only.
void Newton::reduce_and_solve(const Evaluation& e, Step& out) {
  const Structure& shape = model_.shape();
  a_ = r_x_;
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    b_[r] = r_row_[r];
    if (model_.elastic()) b_[r] += r_p_[r] / sigma_p_[r] - r_n_[r] / sigma_n_[r];
    if (model_.equation(r)) continue;
    b_[r] += r_s_[r] / sigma_s_[r];
    const double moved = row_diagonal_[r] * b_[r];
    for (auto k = shape.jacobian_row_begin[r]; k < shape.jacobian_row_begin[r + 1]; ++k)
      a_[shape.jacobian_col[k]] += e.jacobian[k] * moved;
  }
  for (std::size_t i = 0; i < model_.variables(); ++i)
    if (model_.fixed(i)) a_[i] = 0;
  backend_->solve(a_, b_);
  out.x = a_;
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    out.s[r] = 0;
    if (model_.equation(r)) {
      out.y[r] = b_[r];
    } else {
      double product = 0;
      for (auto k = shape.jacobian_row_begin[r]; k < shape.jacobian_row_begin[r + 1]; ++k)
        product += e.jacobian[k] * out.x[shape.jacobian_col[k]];
      out.y[r] = row_diagonal_[r] * (product - b_[r]);
      out.s[r] = (out.y[r] + r_s_[r]) / sigma_s_[r];
    }
    if (!model_.elastic()) continue;
    out.p[r] = (out.y[r] + r_p_[r]) / sigma_p_[r];
    out.n[r] = (r_n_[r] - out.y[r]) / sigma_n_[r];
  }
}

/// Iterative refinement on the unreduced equations: what condensation lost comes back.
void Newton::refine(const Evaluation& e, Step& out) {
  const Structure& shape = model_.shape();
  const auto x0 = r_x_, row0 = r_row_, s0 = r_s_, p0 = r_p_, n0 = r_n_;
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kRefinements; ++pass) {
    double size = 0, scale = 0;
    for (std::size_t i = 0; i < model_.variables(); ++i) {
      r_x_[i] = x0[i] - diagonal_[i] * out.x[i];
      scale = std::max(scale, std::fabs(x0[i]));
    }
    for (std::size_t k = 0; k < shape.hessian_row.size(); ++k) {
      const auto i = shape.hessian_row[k], j = shape.hessian_col[k];
      r_x_[i] -= e.hessian[k] * out.x[j];
      if (i != j) r_x_[j] -= e.hessian[k] * out.x[i];
    }
    for (std::size_t r = 0; r < model_.rows(); ++r) {
      double product = 0;
      for (auto k = shape.jacobian_row_begin[r]; k < shape.jacobian_row_begin[r + 1]; ++k) {
        r_x_[shape.jacobian_col[k]] -= e.jacobian[k] * out.y[r];
        product += e.jacobian[k] * out.x[shape.jacobian_col[k]];
      }
      const bool equation = model_.equation(r);
      r_row_[r] = row0[r] - product + (equation ? delta_c_ * out.y[r] : out.s[r]);
      r_s_[r] = equation ? 0 : s0[r] - (sigma_s_[r] * out.s[r] - out.y[r]);
      if (model_.elastic()) {
        r_row_[r] += out.p[r] - out.n[r];
        r_p_[r] = p0[r] - (sigma_p_[r] * out.p[r] - out.y[r]);
        r_n_[r] = n0[r] - (sigma_n_[r] * out.n[r] + out.y[r]);
      }
      scale = std::max(scale, std::fabs(row0[r]));
      size = std::max({size, std::fabs(r_row_[r]), std::fabs(r_s_[r])});
    }
    for (std::size_t i = 0; i < model_.variables(); ++i)
      if (!model_.fixed(i)) size = std::max(size, std::fabs(r_x_[i]));
    if (size <= 1e-11 * std::max(1.0, scale) || size >= 0.5 * before) break;
    before = size;
    reduce_and_solve(e, correction_);
    for (std::size_t i = 0; i < out.x.size(); ++i) out.x[i] += correction_.x[i];
    for (std::size_t r = 0; r < out.y.size(); ++r) {
      out.y[r] += correction_.y[r];
      out.s[r] += correction_.s[r];
    }
    for (std::size_t r = 0; r < out.p.size(); ++r) {
      out.p[r] += correction_.p[r];
      out.n[r] += correction_.n[r];
    }
  }
}

void Newton::step_for(const Evaluation& e, const Iterate& at, double mu,
                      const std::vector<double>& row_residuals, Step& out) {
  const Structure& shape = model_.shape();
  for (std::size_t i = 0; i < model_.variables(); ++i) {
    double slope = e.gradient[i];
    if (!model_.fixed(i)) {
      if (std::isfinite(limits_.xl[i])) slope -= mu / (at.x[i] - limits_.xl[i]);
      if (std::isfinite(limits_.xu[i])) slope += mu / (limits_.xu[i] - at.x[i]);
    }
    r_x_[i] = -slope;
  }
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    for (auto k = shape.jacobian_row_begin[r]; k < shape.jacobian_row_begin[r + 1]; ++k)
      r_x_[shape.jacobian_col[k]] -= e.jacobian[k] * at.y[r];
    r_row_[r] = -row_residuals[r];
    if (model_.elastic()) {
      r_p_[r] = -(model_.elastic()->rho - at.y[r] - mu / at.p[r]);
      r_n_[r] = -(model_.elastic()->rho + at.y[r] - mu / at.n[r]);
    }
    r_s_[r] = 0;
    if (model_.equation(r)) continue;
    double slope = -at.y[r];
    if (std::isfinite(limits_.gl[r])) slope -= mu / (at.s[r] - limits_.gl[r]);
    if (std::isfinite(limits_.gu[r])) slope += mu / (limits_.gu[r] - at.s[r]);
    r_s_[r] = -slope;
  }
  reduce_and_solve(e, out);
  refine(e, out);
  dual_steps(at, mu, out);
}

void Newton::step(const Evaluation& e, const Iterate& at, double mu, Step& out) {
  static thread_local std::vector<double> residuals;
  residuals.resize(model_.rows());
  for (std::size_t r = 0; r < model_.rows(); ++r) residuals[r] = model_.residual(r, e, at);
  step_for(e, at, mu, residuals, out);
}

void Newton::dual_steps(const Iterate& at, double mu, Step& out) const {
  const auto below = [mu](double slack, double z, double d) {
    return mu / slack - z - z / slack * d;
  };
  for (std::size_t i = 0; i < model_.variables(); ++i) {
    out.zl[i] = out.zu[i] = 0;
    if (model_.fixed(i)) continue;
    if (std::isfinite(limits_.xl[i]))
      out.zl[i] = below(at.x[i] - limits_.xl[i], at.zl[i], out.x[i]);
    if (std::isfinite(limits_.xu[i]))
      out.zu[i] = below(limits_.xu[i] - at.x[i], at.zu[i], -out.x[i]);
  }
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    out.vl[r] = out.vu[r] = 0;
    if (model_.equation(r)) continue;
    if (std::isfinite(limits_.gl[r]))
      out.vl[r] = below(at.s[r] - limits_.gl[r], at.vl[r], out.s[r]);
    if (std::isfinite(limits_.gu[r]))
      out.vu[r] = below(limits_.gu[r] - at.s[r], at.vu[r], -out.s[r]);
  }
  for (std::size_t r = 0; r < out.p.size(); ++r) {
    out.zp[r] = below(at.p[r], at.zp[r], out.p[r]);
    out.zn[r] = below(at.n[r], at.zn[r], out.n[r]);
  }
}

}  // namespace slalom::nlp::ipm
