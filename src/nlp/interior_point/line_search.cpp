#include "line_search.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::nlp::ipm {
namespace {

// Constants of Waechter & Biegler 2006, section 4.
constexpr double kGammaTheta = 1e-5, kGammaPhi = 1e-8, kDelta = 1, kSTheta = 1.1, kSPhi = 2.3;
constexpr double kEta = 1e-8, kGammaAlpha = 0.05, kKappaSoc = 0.99;
constexpr int kMaxCorrections = 4;

/// Shrinks alpha so that slack + alpha * change >= (1 - tau) * slack.
void limit(double& alpha, double slack, double change, double tau) {
  if (change < 0 && alpha * -change > tau * slack) alpha = tau * slack / -change;
}

/// Room for rounding when two values of the barrier function are compared.
double rounding(double barrier) {
  return 1e-14 * 10 * std::fabs(barrier);
}

}  // namespace

void Filter::reset(double most_violation) {
  most_violation_ = most_violation;
  entries_.clear();
}

bool Filter::accepts(double violation, double barrier) const {
  if (!(violation <= most_violation_)) return false;
  return std::all_of(entries_.begin(), entries_.end(), [&](const auto& entry) {
    return violation <= entry.first || barrier <= entry.second + rounding(barrier);
  });
}

void Filter::add(double violation, double barrier) {
  const std::pair corner{(1 - kGammaTheta) * violation, barrier - kGammaPhi * violation};
  std::erase_if(entries_, [&](const auto& entry) {
    return entry.first >= corner.first && entry.second >= corner.second;
  });
  entries_.push_back(corner);
}

double most_primal(const Model& model, const Iterate& at, const Step& step, double tau) {
  const Limits& limits = model.limits();
  double alpha = 1;
  for (std::size_t i = 0; i < model.variables(); ++i) {
    if (model.fixed(i)) continue;
    limit(alpha, at.x[i] - limits.xl[i], step.x[i], tau);
    limit(alpha, limits.xu[i] - at.x[i], -step.x[i], tau);
  }
  for (std::size_t r = 0; r < model.rows(); ++r) {
    if (model.equation(r)) continue;
    limit(alpha, at.s[r] - limits.gl[r], step.s[r], tau);
    limit(alpha, limits.gu[r] - at.s[r], -step.s[r], tau);
  }
  for (std::size_t r = 0; r < at.p.size(); ++r) {
    limit(alpha, at.p[r], step.p[r], tau);
    limit(alpha, at.n[r], step.n[r], tau);
  }
  return alpha;
}

double most_dual(const Model& model, const Iterate& at, const Step& step, double tau) {
  double alpha = 1;
  for (std::size_t i = 0; i < model.variables(); ++i) {
    limit(alpha, at.zl[i], step.zl[i], tau);
    limit(alpha, at.zu[i], step.zu[i], tau);
  }
  for (std::size_t r = 0; r < model.rows(); ++r) {
    limit(alpha, at.vl[r], step.vl[r], tau);
    limit(alpha, at.vu[r], step.vu[r], tau);
  }
  for (std::size_t r = 0; r < at.zp.size(); ++r) {
    limit(alpha, at.zp[r], step.zp[r], tau);
    limit(alpha, at.zn[r], step.zn[r], tau);
  }
  return alpha;
}

LineSearch::LineSearch(Model& model) : model_(model) {
  const bool elastic = model.elastic() != nullptr;
  trial_.resize(model.variables(), model.rows(), elastic);
  corrected_.resize(model.variables(), model.rows(), elastic);
  residuals_.resize(model.rows());
}

void LineSearch::reset(double violation_at_start) {
  most_violation_ = 1e4 * std::max(1.0, violation_at_start);
  small_violation_ = 1e-4 * std::max(1.0, violation_at_start);
  filter_.reset(most_violation_);
}

bool LineSearch::trial(const Iterate& at, const Step& step, double alpha, double mu, Merit& merit) {
  for (std::size_t i = 0; i < at.x.size(); ++i) trial_.x[i] = at.x[i] + alpha * step.x[i];
  for (std::size_t r = 0; r < at.s.size(); ++r) trial_.s[r] = at.s[r] + alpha * step.s[r];
  for (std::size_t r = 0; r < at.p.size(); ++r) {
    trial_.p[r] = at.p[r] + alpha * step.p[r];
    trial_.n[r] = at.n[r] + alpha * step.n[r];
  }
  if (!model_.values(trial_, trial_values_)) return false;
  merit.violation = model_.violation(trial_values_, trial_);
  merit.barrier = model_.barrier(trial_values_, trial_, mu);
  return std::isfinite(merit.violation) && std::isfinite(merit.barrier);
}

bool LineSearch::acceptable(const Merit& now, const Merit& trial, double slope, double alpha,
                            bool& armijo) {
  if (!filter_.accepts(trial.violation, trial.barrier)) return false;
  const bool descent =
      slope < 0 && alpha * std::pow(-slope, kSPhi) > kDelta * std::pow(now.violation, kSTheta);
  armijo = descent && now.violation <= small_violation_;
  if (armijo) return trial.barrier <= now.barrier + kEta * alpha * slope + rounding(now.barrier);
  return trial.violation <= (1 - kGammaTheta) * now.violation ||
         trial.barrier <= now.barrier - kGammaPhi * now.violation + rounding(now.barrier);
}

LineSearch::Result LineSearch::search(Newton& newton, double mu, const Step& step, Evaluation& e,
                                      Iterate& at) {
  const double tau = std::max(0.99, 1 - mu);
  const Merit now{model_.violation(e, at), model_.barrier(e, at, mu)};
  const Limits& limits = model_.limits();
  double slope = 0;  // of the barrier function along the step
  for (std::size_t i = 0; i < at.x.size(); ++i) {
    if (model_.fixed(i)) continue;
    double g = e.gradient[i];
    if (std::isfinite(limits.xl[i])) g -= mu / (at.x[i] - limits.xl[i]);
    if (std::isfinite(limits.xu[i])) g += mu / (limits.xu[i] - at.x[i]);
    slope += g * step.x[i];
  }
  for (std::size_t r = 0; r < at.s.size(); ++r) {
    if (model_.equation(r)) continue;
    double g = 0;
    if (std::isfinite(limits.gl[r])) g -= mu / (at.s[r] - limits.gl[r]);
    if (std::isfinite(limits.gu[r])) g += mu / (limits.gu[r] - at.s[r]);
    slope += g * step.s[r];
  }
  for (std::size_t r = 0; r < at.p.size(); ++r)
    slope += (model_.elastic()->rho - mu / at.p[r]) * step.p[r] +
             (model_.elastic()->rho - mu / at.n[r]) * step.n[r];
  double least = kGammaTheta;
  if (slope < 0) {
    least = std::min(least, kGammaPhi * now.violation / -slope);
    if (now.violation <= small_violation_)
      least = std::min(least, kDelta * std::pow(now.violation, kSTheta) / std::pow(-slope, kSPhi));
  }
  least *= kGammaAlpha;

  Result result;
  result.alpha_dual = most_dual(model_, at, step, tau);
  bool armijo = false;
  for (double alpha = most_primal(model_, at, step, tau); alpha > least || result.trials == 0;
       alpha /= 2) {
    ++result.trials;
    Merit merit{};
    const bool finite = trial(at, step, alpha, mu, merit);
    if (finite && acceptable(now, merit, slope, alpha, armijo)) {
      result.accepted = true;
      result.alpha = alpha;
    } else if (finite && result.trials == 1 && merit.violation >= now.violation) {
      result.accepted = correct(newton, e, at, mu, now, slope, alpha, tau, result);
    }
    if (!result.accepted) continue;
    if (!armijo) filter_.add(now.violation, now.barrier);
    at.x = trial_.x;
    at.s = trial_.s;
    at.p = trial_.p;
    at.n = trial_.n;
    e.objective = trial_values_.objective;
    e.rows = trial_values_.rows;
    return result;
  }
  return result;
}

bool LineSearch::correct(Newton& newton, const Evaluation& e, const Iterate& at, double mu,
                         const Merit& now, double slope, double alpha, double tau, Result& result) {
  double before = model_.violation(trial_values_, trial_), length = alpha;
  for (std::size_t r = 0; r < residuals_.size(); ++r) residuals_[r] = model_.residual(r, e, at);
  for (int k = 0; k < kMaxCorrections; ++k) {
    ++result.corrections;
    for (std::size_t r = 0; r < residuals_.size(); ++r)
      residuals_[r] = length * residuals_[r] + model_.residual(r, trial_values_, trial_);
    newton.step_for(e, at, mu, residuals_, corrected_);
    length = most_primal(model_, at, corrected_, tau);
    Merit merit{};
    if (!trial(at, corrected_, length, mu, merit)) return false;
    bool armijo = false;
    if (acceptable(now, merit, slope, alpha, armijo)) {
      result.alpha = length;
      return true;
    }
    if (merit.violation > kKappaSoc * before) return false;
    before = merit.violation;
  }
  return false;
}

}  // namespace slalom::nlp::ipm
