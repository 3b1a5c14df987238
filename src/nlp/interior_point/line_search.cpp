#include "line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace slalom::nlp::ipm {
namespace {

// Constants of Waechter & Biegler 2006, section 4.
constexpr double kGammaTheta = 1e-5, kGammaPhi = 1e-8, kDelta = 1, kSTheta = 1.1, kSPhi = 2.3;
constexpr double kEta = 1e-8, kGammaAlpha = 0.05, kKappaSoc = 0.99, kTau = 0.99;
constexpr double kRounding = 1e-15;
constexpr double kMostMultiplier = 1e6;
constexpr int kMaxCorrections = 4;
constexpr int kBlockedSearches = 4;
constexpr double kLessViolation = 0.1;

/// How far the rows' multipliers go along with a primal step. W&B move them by alpha; but where
/// alpha is small they would stay far from the bounds' multipliers, which go on by a step of their
/// own, and so would the Hessian of the Lagrangian, and the next step be no better. A huge change,
/// of rows that nearly depend on each other, says nothing.
double row_alpha(double alpha, double alpha_dual, double size) {
  return alpha < 0.03 && size < kMostMultiplier ? std::max(alpha, alpha_dual) : alpha;
}

double longest(double reach, double mu) {
  const double tau = boundary_fraction(mu);
  return reach > tau ? tau / reach : 1;
}

}  // namespace

double boundary_fraction(double mu) {
  return std::max(kTau, 1 - mu);
}

Merit merit(const Point& point, double mu) {
  return {point.violation(), barrier_function(point, mu)};
}

LineSearch::LineSearch(SlackForm& form) : form_(form), trial_(form), residuals_(form.rows()) {
  corrected_.resize(form.primal(), form.rows());
}

void LineSearch::reset(double violation_at_start) {
  most_violation_ = 1e4 * std::max(1.0, violation_at_start);
  small_violation_ = 1e-4 * std::max(1.0, violation_at_start);
  filter_.reset(most_violation_);
  blocked_ = 0;
}

/// Pairs from another region may block good steps here (section 3.2, accelerating heuristics):
/// where they alone did so in several searches in a row, they go, for a tighter bound on the
/// violation.
void LineSearch::note_blocked(bool by_filter, const Merit& now) {
  blocked_ = by_filter ? blocked_ + 1 : 0;
  if (blocked_ < kBlockedSearches || now.violation >= kLessViolation * most_violation_) return;
  most_violation_ *= kLessViolation;
  filter_.reset(most_violation_);
  blocked_ = 0;
}

double LineSearch::slope(const Point& point, const BarrierTerms& terms, const Step& step) const {
  return form_.derivative_along(point.functions(), terms.slope, step.w);
}

bool LineSearch::acceptable(const Merit& now, const Merit& trial, double slope,
                            double alpha) const {
  return filter_.accepts(trial) && progresses(now, trial, slope, alpha);
}

void LineSearch::leave(const Merit& now, double slope, double alpha) {
  if (!armijo(now, slope, alpha)) filter_.add(now);
}

/// Whether the step is one of descent, on which the barrier function alone judges (eq. 19).
bool LineSearch::armijo(const Merit& now, double slope, double alpha) const {
  const bool descent =
      slope < 0 && alpha * std::pow(-slope, kSPhi) > kDelta * std::pow(now.violation, kSTheta);
  return descent && now.violation <= small_violation_;
}

bool LineSearch::progresses(const Merit& now, const Merit& trial, double slope,
                            double alpha) const {
  if (armijo(now, slope, alpha))
    return trial.barrier <= now.barrier + kEta * alpha * slope + rounding(now.barrier);
  return trial.violation <= (1 - kGammaTheta) * now.violation ||
         trial.barrier <= now.barrier - kGammaPhi * now.violation + rounding(now.barrier);
}

/// Evaluates trial_ = from + alpha step.
bool LineSearch::try_step(const Point& from, const Step& step, double alpha, double mu,
                          bool derivatives, Merit& merit) {
  const double y_alpha = row_alpha(alpha, longest(step.reach.dual, mu),
                                   vector_kernels().largest_magnitude(form_.rows(), step.y.data()));
  trial_.set_along(from, step, alpha, y_alpha);
  if (!std::isfinite(trial_.log_slacks())) return false;
  if (!trial_.evaluate({.values = true, .derivatives = derivatives, .hessian = derivatives}))
    return false;
  merit = ipm::merit(trial_, mu);
  return std::isfinite(merit.violation) && std::isfinite(merit.barrier);
}

/// Where backtracking ends (eq. 23), and no shorter than rounding lets a step be.
double LineSearch::least_alpha(const Origin& from) const {
  const Merit& now = from.merit;
  double least = kGammaTheta, change = 0;
  if (from.slope < 0) {
    least = std::min(least, kGammaPhi * now.violation / -from.slope);
    if (now.violation <= small_violation_)
      least =
          std::min(least, kDelta * std::pow(now.violation, kSTheta) / std::pow(-from.slope, kSPhi));
  }
  if (kGammaAlpha * least > kRounding) return kGammaAlpha * least;
  const std::vector<double>&w = from.point.at().w, &dw = from.step.w;
  for (std::size_t i = 0; i < form_.primal(); ++i)
    change = std::max(change, std::fabs(dw[i]) / (1 + std::fabs(w[i])));
  return std::max(kGammaAlpha * least, kRounding / change);
}

LineSearch::Result LineSearch::search(Newton& newton, const BarrierTerms& terms, const Step& step,
                                      Point& point) {
  const Origin from{point, terms, step, merit(point, terms.mu), slope(point, terms, step)};
  const Merit now = from.merit;
  const double least = least_alpha(from);
  Result result;
  result.alpha_dual = longest(step.reach.dual, terms.mu);
  bool by_filter = false;
  for (double alpha = longest(step.reach.primal, terms.mu); alpha > least || result.trials == 0;
       alpha /= 2) {
    ++result.trials;
    Merit trial{};
    const bool finite = try_step(point, step, alpha, terms.mu, result.trials == 1, trial);
    result.fault = finite ? Fault{} : form_.fault();
    if (finite && acceptable(now, trial, from.slope, alpha)) {
      result.accepted = true;
      result.alpha = alpha;
    } else if (finite && result.trials == 1 && trial.violation >= now.violation) {
      result.accepted = correct(newton, from, alpha, result);
    }
    if (!result.accepted) {
      by_filter = finite && progresses(now, trial, from.slope, alpha);
      continue;
    }
    note_blocked(by_filter, now);
    leave(now, from.slope, alpha);
    point.swap_all_but_bounds(trial_);
    return result;
  }
  return result;
}

bool LineSearch::leap(double mu, const Step& step, Point& point, Result& result) {
  Merit ignored{};
  result.alpha = longest(step.reach.primal, mu);
  result.alpha_dual = longest(step.reach.dual, mu);
  if (!try_step(point, step, result.alpha, mu, true, ignored)) return false;
  point.swap_all_but_bounds(trial_);
  return true;
}

/// Second-order corrections (section 2.4): the step again with the rows' residuals at its end.
bool LineSearch::correct(Newton& newton, const Origin& from, double alpha, Result& result) {
  const double mu = from.terms.mu;
  double before = trial_.violation(), length = alpha;
  std::copy_n(from.point.residuals().begin(), residuals_.size(), residuals_.begin());
  for (int k = 0; k < kMaxCorrections; ++k) {
    ++result.corrections;
    for (std::size_t r = 0; r < residuals_.size(); ++r)
      residuals_[r] = length * residuals_[r] + trial_.residuals()[r];
    if (!newton.step_for(from.point, from.terms, residuals_, corrected_)) return false;
    length = longest(corrected_.reach.primal, mu);
    corrected_.y = from.step.y;
    Merit trial{};
    if (!try_step(from.point, corrected_, length, mu, false, trial)) return false;
    if (acceptable(from.merit, trial, from.slope, alpha)) {
      result.alpha = length;
      return true;
    }
    if (trial.violation > kKappaSoc * before) return false;
    before = trial.violation;
  }
  return false;
}

}  // namespace slalom::nlp::ipm
