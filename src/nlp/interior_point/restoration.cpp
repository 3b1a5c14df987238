#include "restoration.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::nlp::ipm {

Restoration::Restoration(Problem& problem)
    : model_(problem, elastic_), newton_(model_), search_(model_) {
  at_.resize(model_.variables(), model_.rows(), true);
  step_.resize(model_.variables(), model_.rows(), true);
}

double Restoration::begin(double mu, const Iterate& from) {
  elastic_.reference = from.x;
  elastic_.weight.resize(from.x.size());
  for (std::size_t i = 0; i < from.x.size(); ++i) {
    const double d = 1 / std::max(1.0, std::fabs(from.x[i]));
    elastic_.weight[i] = d * d;
  }
  at_.x = from.x;
  at_.s = from.s;
  std::fill(at_.y.begin(), at_.y.end(), 0.0);
  std::fill(at_.p.begin(), at_.p.end(), 0.0);
  std::fill(at_.n.begin(), at_.n.end(), 0.0);
  model_.values(at_, e_);
  for (std::size_t r = 0; r < model_.rows(); ++r)
    mu = std::max(mu, std::fabs(model_.residual(r, e_, at_)));
  elastic_.zeta = std::sqrt(mu);
  const Limits& limits = model_.limits();
  const auto cap = [&](double slack) {
    return std::isfinite(slack) ? std::min(elastic_.rho, mu / slack) : 0;
  };
  for (std::size_t i = 0; i < at_.x.size(); ++i) {
    if (model_.fixed(i)) continue;
    at_.zl[i] = cap(at_.x[i] - limits.xl[i]);
    at_.zu[i] = cap(limits.xu[i] - at_.x[i]);
  }
  for (std::size_t r = 0; r < model_.rows(); ++r) {
    // Eq. 32, 33: p, n >= 0 that fit the residual and minimise their own barrier function.
    const double c = model_.residual(r, e_, at_);
    const double half = (mu - elastic_.rho * c) / (2 * elastic_.rho);
    at_.n[r] = half + std::sqrt(half * half + mu * c / (2 * elastic_.rho));
    at_.p[r] = c + at_.n[r];
    const double least = 1e-12 * std::max(1.0, std::fabs(c));
    at_.n[r] = std::max(at_.n[r], least);
    at_.p[r] = std::max(at_.p[r], least);
    at_.zp[r] = mu / at_.p[r];
    at_.zn[r] = mu / at_.n[r];
    if (model_.equation(r)) continue;
    at_.vl[r] = cap(at_.s[r] - limits.gl[r]);
    at_.vu[r] = cap(limits.gu[r] - at_.s[r]);
  }
  return mu;
}

void advance_duals(const Model& model, const Step& step, double alpha, double alpha_dual, double mu,
                   Iterate& at) {
  constexpr double kSigma = 1e10;
  const Limits& limits = model.limits();
  const auto guard = [&](double& z, double change, double slack) {
    if (!std::isfinite(slack)) return;
    z = std::clamp(z + alpha_dual * change, mu / (kSigma * slack), kSigma * mu / slack);
  };
  for (std::size_t i = 0; i < model.variables(); ++i) {
    if (model.fixed(i)) continue;
    guard(at.zl[i], step.zl[i], at.x[i] - limits.xl[i]);
    guard(at.zu[i], step.zu[i], limits.xu[i] - at.x[i]);
  }
  for (std::size_t r = 0; r < model.rows(); ++r) {
    at.y[r] += alpha * step.y[r];
    if (model.elastic()) {
      guard(at.zp[r], step.zp[r], at.p[r]);
      guard(at.zn[r], step.zn[r], at.n[r]);
    }
    if (model.equation(r)) continue;
    guard(at.vl[r], step.vl[r], at.s[r] - limits.gl[r]);
    guard(at.vu[r], step.vu[r], limits.gu[r] - at.s[r]);
  }
}

double scaled_error(const Model& model, const Evaluation& e, const Iterate& at, double mu) {
  const auto r = model.residuals(e, at, mu);
  double bounds = 0, rows = 0;
  std::size_t count = 0;
  for (const auto* list : {&at.zl, &at.zu, &at.vl, &at.vu, &at.zp, &at.zn}) {
    for (double z : *list) bounds += z;
    count += list->size();
  }
  for (double y : at.y) rows += std::fabs(y);
  const auto scale = [](double sum, std::size_t n) {
    return std::max(100.0, sum / static_cast<double>(std::max<std::size_t>(n, 1))) / 100;
  };
  const double s_d = scale(rows + bounds, count + at.y.size()), s_c = scale(bounds, count);
  return std::max({r.dual / s_d, r.primal, r.complementarity / s_c});
}

double next_barrier(double mu, double least) {
  return std::max(least, std::min(0.2 * mu, std::pow(mu, 1.5)));
}

}  // namespace slalom::nlp::ipm
