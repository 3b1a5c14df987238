#include "newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slalom::nlp::ipm {
namespace {

// Algorithm IC of Waechter & Biegler 2006.
constexpr double kFirstDelta = 1e-4, kLeastDelta = 1e-20, kMostDelta = 1e40;
constexpr double kFirstGrowth = 100, kGrowth = 8, kShrink = 1.0 / 3;
constexpr double kRowDelta = 1e-8, kRowPower = 0.25;
/// Attempts with no stable pivot although rows may give: beyond, it is rounding, not the rank.
constexpr int kMostSingular = 3;

constexpr int kRefinements = 5;
/// Residuals relative to the right-hand side: good enough to stop refining, bad enough to ask for
/// other pivots.
constexpr double kGoodResidual = 1e-9, kBadResidual = 1e-5;

}  // namespace

void Local::resize(const Model& model) {
  for (auto* list : {&over_lower, &over_upper, &sigma, &slope}) list->assign(model.primal(), 0.0);
  residuals.assign(model.rows(), 0.0);
}

BoundedVector Local::bounded(const Model& model, const Iterate& at) const {
  return {at.w.data(),  model.lower().data(), model.upper().data(), at.zl.data(),
          at.zu.data(), over_lower.data(),    over_upper.data()};
}

Newton::Newton(Model& model) : model_(model), backend_(kkt::make_stage_ldlt(model.pattern())) {
  const std::size_t equations = model.equations().size();
  for (std::size_t i = 0; i < model.variables(); ++i) wanted_.positive += model.fixed(i) ? 0 : 1;
  wanted_.negative = equations;
  for (auto* list : {&sigma_x_, &force_}) list->resize(model.variables());
  for (auto* list : {&weight_, &give_, &row_rhs_, &multipliers_, &products_})
    list->assign(model.rows(), 0.0);
  flexibility_.resize(equations);
  hessian_.resize(model.condensed().places().size());
  no_hessian_.assign(model.shape().hessian_row.size(), 0.0);
  rhs_.resize(model.variables() + equations);
  solution_.resize(rhs_.size());
}

/// What each eliminated row weighs in the condensed system.
void Newton::weigh(const Local& local) {
  const double* sigma = local.sigma.data() + model_.variables();
  if (!model_.elastic()) {
    std::copy_n(sigma, model_.rows(), weight_.data());  // 0 for an equation
    return;
  }
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    give_[r] = 1 / local.sigma[model_.p(r)] + 1 / local.sigma[model_.n(r)];
    weight_[r] = model_.equation(r) ? 0 : 1 / (1 / sigma[r] + give_[r]);
  }
}

bool Newton::factorize(const Evaluation& e, const Local& local, double mu) {
  weigh(local);
  model_.condensed().sum(e.hessian, e.jacobian, weight_, hessian_);
  delta_c_ = 0;
  return find_regularisation(e, local, mu);
}

bool Newton::factorize_as_singular(const Evaluation& e, const Local& local, double mu) {
  delta_c_ = row_regularisation(mu);
  return find_regularisation(e, local, mu);
}

double Newton::row_regularisation(double mu) {
  return kRowDelta * std::pow(mu, kRowPower);
}

bool Newton::deadline_passed(void* self) {
  auto* newton = static_cast<Newton*>(self);
  return newton->gave_up_ = newton->deadline_->passed();
}

/// Algorithm IC.
bool Newton::find_regularisation(const Evaluation& e, const Local& local, double mu) {
  const auto attempt = [&] {
    for (std::size_t i = 0; i < sigma_x_.size(); ++i)
      sigma_x_[i] = local.sigma[i] + delta_w_ + (model_.elastic() ? model_.proximity(i) : 0);
    for (std::size_t k = 0; k < flexibility_.size(); ++k)
      flexibility_[k] = delta_c_ + give_[model_.equations()[k]];
    return backend_->factorize({hessian_, sigma_x_, e.jacobian, flexibility_, true,
                                deadline_ != nullptr ? &Newton::deadline_passed : nullptr, this});
  };
  gave_up_ = false;
  delta_w_ = 0;
  auto inertia = attempt();
  if (gave_up_) return false;
  if (inertia == wanted_) return true;
  if (inertia.zero > 0) delta_c_ = row_regularisation(mu);
  delta_w_ = last_delta_w_ == 0 ? kFirstDelta : std::max(kLeastDelta, last_delta_w_ * kShrink);
  for (int singular = 0; delta_w_ < kMostDelta && singular < kMostSingular;) {
    const bool relaxed = delta_c_ > 0;
    inertia = attempt();
    if (gave_up_) return false;
    if (inertia == wanted_) {
      last_delta_w_ = delta_w_;
      return true;
    }
    singular += relaxed && inertia.zero > 0;
    if (inertia.zero > 0) delta_c_ = row_regularisation(mu);
    delta_w_ *= last_delta_w_ == 0 ? kFirstGrowth : kGrowth;
  }
  return false;
}

/// Right-hand side of the condensed system. In r_s = y - slope of a slack and likewise of elastic
/// parts, the eliminated rows read  J dx - F dy = b,  F = 1 / sigma_s + give.
void Newton::shift(const Local& local, const Iterate& at, std::span<const double> residuals) {
  const std::size_t n = model_.variables();
  const double* slope = local.slope.data() + n;
  if (!model_.elastic()) {
    // y - b / F = sigma residual + slope of an inequality
    vector_kernels().multiply_add(model_.rows(), weight_.data(), residuals.data(), slope,
                                  multipliers_.data());
    for (const auto r : model_.equations()) {
      multipliers_[r] = at.y[r];
      row_rhs_[r] = -residuals[r];
    }
    return;
  }
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    const std::size_t p = model_.p(r), q = model_.n(r);
    const double r_p = -(model_.elastic()->rho - at.y[r] + local.slope[p]);
    const double r_n = -(model_.elastic()->rho + at.y[r] + local.slope[q]);
    row_rhs_[r] = -residuals[r] + r_p / local.sigma[p] - r_n / local.sigma[q];
    if (!model_.equation(r)) row_rhs_[r] += (at.y[r] - slope[r]) / local.sigma[n + r];
    multipliers_[r] = at.y[r] - weight_[r] * row_rhs_[r];
  }
}

bool Newton::step_for(const Evaluation& e, const Local& local, const Iterate& at, double mu,
                      std::span<const double> residuals, Step& out) {
  const auto& kernels = vector_kernels();
  const std::size_t n = model_.variables();
  shift(local, at, residuals);
  std::fill(force_.begin(), force_.end(), 0.0);
  model_.row_blocks().add_transposed(e.jacobian, multipliers_, force_);
  for (std::size_t i = 0; i < n; ++i) rhs_[i] = -e.gradient[i] - local.slope[i] - force_[i];
  for (std::size_t k = 0; k < model_.equations().size(); ++k)
    rhs_[n + k] = row_rhs_[model_.equations()[k]];
  for (std::size_t i = 0; i < n; ++i)
    if (model_.fixed(i)) rhs_[i] = 0;
  const double size = kernels.largest_magnitude(rhs_.size(), rhs_.data());
  solution_ = rhs_;
  backend_->solve(solution_);
  recover(e, local, at, residuals, out);
  double before = std::numeric_limits<double>::infinity(), left = 0;
  for (int pass = 0;; ++pass) {
    left = unsolved(e, local, at, residuals, out);
    if (!(left > kGoodResidual * std::max(size, 1e-3)) || !(left < 0.5 * before) ||
        pass == kRefinements)
      break;
    before = left;
    backend_->solve(solution_);
    add_correction(e, local, out);
  }
  accurate_ = left <= kBadResidual * std::max(size, 1e-3);
  if (!accurate_) backend_->distrust();
  out.reach = kernels.dual_step(model_.segments(), local.bounded(model_, at), mu, out.w.data(),
                                out.zl.data(), out.zu.data());
  return std::isfinite(left + out.reach.primal + out.reach.dual);
}

/// The system  [I J'; J 0] (d, y) = (-gradient, 0)  with a unit weight on slacks too, condensed.
bool Newton::fit_multipliers(const Evaluation& e, const Iterate& at, Step& out) {
  const std::size_t n = model_.variables();
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    weight_[r] = model_.equation(r) ? 0 : 1;
    multipliers_[r] = model_.equation(r) ? 0 : at.zu[n + r] - at.zl[n + r];
  }
  model_.condensed().sum(no_hessian_, e.jacobian, weight_, hessian_);
  std::fill(sigma_x_.begin(), sigma_x_.end(), 1.0);
  std::fill(flexibility_.begin(), flexibility_.end(), 0.0);
  if (backend_->factorize({hessian_, sigma_x_, e.jacobian, flexibility_}) != wanted_) return false;
  std::fill(force_.begin(), force_.end(), 0.0);
  model_.row_blocks().add_transposed(e.jacobian, multipliers_, force_);
  std::fill(solution_.begin(), solution_.end(), 0.0);
  for (std::size_t i = 0; i < n; ++i)
    if (!model_.fixed(i)) solution_[i] = -(e.gradient[i] - at.zl[i] + at.zu[i] + force_[i]);
  backend_->solve(solution_);
  model_.row_blocks().multiply(e.jacobian, std::span(solution_).first(n), products_);
  for (std::size_t r = 0; r < model_.rows(); ++r)
    out.y[r] = multipliers_[r] + weight_[r] * products_[r];
  for (std::size_t k = 0; k < model_.equations().size(); ++k)
    out.y[model_.equations()[k]] = solution_[n + k];
  return true;
}

bool Newton::step(const Evaluation& e, const Local& local, const Iterate& at, double mu,
                  Step& out) {
  return step_for(e, local, at, mu, local.residuals, out);
}

/// The eliminated parts of the step from dx and the equations' dy.
void Newton::recover(const Evaluation& e, const Local& local, const Iterate& at,
                     std::span<const double> residuals, Step& out) {
  const std::size_t n = model_.variables();
  std::copy_n(solution_.begin(), n, out.w.begin());
  model_.row_blocks().multiply(e.jacobian, std::span(out.w).first(n), products_);
  double* ds = out.w.data() + n;
  const double* slope = local.slope.data() + n;
  if (!model_.elastic()) {
    vector_kernels().combine(model_.rows(), products_.data(), 1, residuals.data(), ds);
    vector_kernels().multiply_add(model_.rows(), weight_.data(), ds, slope, out.y.data());
    vector_kernels().combine(model_.rows(), out.y.data(), -1, at.y.data(), out.y.data());
    for (std::size_t k = 0; k < model_.equations().size(); ++k) {
      ds[model_.equations()[k]] = 0;
      out.y[model_.equations()[k]] = solution_[n + k];
    }
    return;
  }
  for (std::size_t r = 0; r < model_.rows(); ++r)
    out.y[r] = weight_[r] * (products_[r] - row_rhs_[r]);
  for (std::size_t k = 0; k < model_.equations().size(); ++k)
    out.y[model_.equations()[k]] = solution_[n + k];
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    const std::size_t p = model_.p(r), q = model_.n(r);
    const double r_p = -(model_.elastic()->rho - at.y[r] + local.slope[p]);
    const double r_n = -(model_.elastic()->rho + at.y[r] + local.slope[q]);
    out.w[p] = (out.y[r] + r_p) / local.sigma[p];
    out.w[q] = (r_n - out.y[r]) / local.sigma[q];
    ds[r] = model_.equation(r) ? 0 : products_[r] + residuals[r] - out.w[p] + out.w[q];
  }
}

/// Residual of the unreduced equations, into solution_ as the right-hand side of a correction. Of
/// the eliminated rows nothing is left, by construction. products_ holds J dx.
double Newton::unsolved(const Evaluation& e, const Local& local, const Iterate& at,
                        std::span<const double> residuals, const Step& out) {
  const auto& kernels = vector_kernels();
  const std::size_t n = model_.variables();
  kernels.combine(model_.rows(), at.y.data(), 1, out.y.data(), multipliers_.data());
  std::fill(force_.begin(), force_.end(), 0.0);
  model_.row_blocks().add_transposed(e.jacobian, multipliers_, force_);
  model_.hessian_runs().add_product(e.hessian, std::span(out.w).first(n), force_);
  for (std::size_t i = 0; i < n; ++i)
    solution_[i] = model_.fixed(i)
                       ? 0
                       : -(e.gradient[i] + local.slope[i] + force_[i] + sigma_x_[i] * out.w[i]);
  for (std::size_t k = 0; k < model_.equations().size(); ++k) {
    const std::size_t r = model_.equations()[k];
    double left = -residuals[r] - products_[r] + delta_c_ * out.y[r];
    if (model_.elastic()) left += out.w[model_.p(r)] - out.w[model_.n(r)];
    solution_[n + k] = left;
  }
  return kernels.largest_magnitude(solution_.size(), solution_.data());
}

/// Adds a correction of dx and the equations' dy, and what it brings to the eliminated parts.
void Newton::add_correction(const Evaluation& e, const Local& local, Step& out) {
  const std::size_t n = model_.variables();
  for (std::size_t i = 0; i < n; ++i) out.w[i] += solution_[i];
  model_.row_blocks().multiply(e.jacobian, std::span(solution_).first(n), row_rhs_);
  for (std::size_t r = 0; r < model_.rows(); ++r) multipliers_[r] = weight_[r] * row_rhs_[r];
  for (std::size_t k = 0; k < model_.equations().size(); ++k)
    multipliers_[model_.equations()[k]] = solution_[n + k];
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    products_[r] += row_rhs_[r];
    out.y[r] += multipliers_[r];
    double moved = row_rhs_[r];
    if (model_.elastic()) {
      const double dp = multipliers_[r] / local.sigma[model_.p(r)];
      const double dn = -multipliers_[r] / local.sigma[model_.n(r)];
      out.w[model_.p(r)] += dp;
      out.w[model_.n(r)] += dn;
      moved += dn - dp;
    }
    if (!model_.equation(r)) out.w[n + r] += moved;
  }
}

}  // namespace slalom::nlp::ipm
