#include "line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

void Point::resize(const Model& model) {
  at.resize(model.primal(), model.rows());
  e.gradient.resize(model.variables());
  e.rows.resize(model.rows());
  e.jacobian.resize(model.shape().jacobian_row.size());
  e.hessian.resize(model.shape().hessian_row.size());
  local.resize(model);
  have = {};
}

double boundary_fraction(double mu) {
  return std::max(kTau, 1 - mu);
}

void measure(const Model& model, Point& point) {
  const auto& kernels = vector_kernels();
  const BoundedVector bounded = point.local.bounded(model, point.at);
  kernels.reciprocals(model.segments(), bounded, point.local.over_lower.data(),
                      point.local.over_upper.data());
  point.logs = kernels.log_slacks(model.segments(), bounded);
  point.local.violation = model.residuals(point.e, point.at.w, point.local.residuals);
  point.measured = true;
}

double barrier_function(const Point& point, double mu) {
  return point.e.objective - mu * point.logs;
}

LineSearch::LineSearch(Model& model) : model_(model) {
  trial_.resize(model);
  corrected_.resize(model.primal(), model.rows());
  residuals_.resize(model.rows());
}

void LineSearch::reset(double violation_at_start) {
  most_violation_ = 1e4 * std::max(1.0, violation_at_start);
  small_violation_ = 1e-4 * std::max(1.0, violation_at_start);
  filter_.reset(most_violation_);
  blocked_ = 0;
}

/// Pairs from another region may block good steps here (section 3.2, accelerating heuristics):
/// where they alone did so in several searches on end, they go, for a tighter bound on the
/// violation.
void LineSearch::note_blocked(bool by_filter, const Merit& now) {
  blocked_ = by_filter ? blocked_ + 1 : 0;
  if (blocked_ < kBlockedSearches || now.violation >= kLessViolation * most_violation_) return;
  most_violation_ *= kLessViolation;
  filter_.reset(most_violation_);
  blocked_ = 0;
}

Merit LineSearch::merit(const Point& point, double mu) const {
  return {point.local.violation, barrier_function(point, mu)};
}

double LineSearch::slope(const Point& point, const Step& step) const {
  const auto& kernels = vector_kernels();
  double slope = kernels.dot(model_.variables(), point.e.gradient.data(), step.w.data()) +
                 kernels.dot(model_.primal(), point.local.slope.data(), step.w.data());
  if (model_.elastic())
    for (std::size_t i = model_.p(0); i < model_.primal(); ++i)
      slope += model_.elastic()->rho * step.w[i];
  return slope;
}

/// Evaluates trial_ = from + alpha step.
bool LineSearch::try_step(const Point& from, const Step& step, double alpha, double mu,
                          bool derivatives, Merit& merit) {
  const auto& kernels = vector_kernels();
  const double y_alpha = row_alpha(alpha, longest(step.reach.dual, mu),
                                   kernels.largest_magnitude(model_.rows(), step.y.data()));
  kernels.combine(model_.primal(), from.at.w.data(), alpha, step.w.data(), trial_.at.w.data());
  kernels.combine(model_.rows(), from.at.y.data(), y_alpha, step.y.data(), trial_.at.y.data());
  trial_.logs = kernels.log_slacks(model_.segments(), trial_.local.bounded(model_, trial_.at));
  trial_.measured = false;
  if (!std::isfinite(trial_.logs)) return false;
  trial_.have = {.values = true, .derivatives = derivatives, .hessian = derivatives};
  if (!model_.evaluate(trial_.at, trial_.have, trial_.e)) return false;
  trial_.local.violation = model_.residuals(trial_.e, trial_.at.w, trial_.local.residuals);
  merit = {trial_.local.violation, barrier_function(trial_, mu)};
  return std::isfinite(merit.violation) && std::isfinite(merit.barrier);
}

bool LineSearch::acceptable(const Merit& now, const Merit& trial, double slope, double alpha,
                            bool& armijo) {
  return filter_.accepts(trial) && progresses(now, trial, slope, alpha, armijo);
}

bool LineSearch::progresses(const Merit& now, const Merit& trial, double slope, double alpha,
                            bool& armijo) const {
  const bool descent =
      slope < 0 && alpha * std::pow(-slope, kSPhi) > kDelta * std::pow(now.violation, kSTheta);
  armijo = descent && now.violation <= small_violation_;
  if (armijo) return trial.barrier <= now.barrier + kEta * alpha * slope + rounding(now.barrier);
  return trial.violation <= (1 - kGammaTheta) * now.violation ||
         trial.barrier <= now.barrier - kGammaPhi * now.violation + rounding(now.barrier);
}

/// Where backtracking ends (eq. 23), and no shorter than rounding lets a step be.
double LineSearch::least_alpha(const Merit& now, double slope, const Point& point,
                               const Step& step) const {
  double least = kGammaTheta, change = 0;
  if (slope < 0) {
    least = std::min(least, kGammaPhi * now.violation / -slope);
    if (now.violation <= small_violation_)
      least = std::min(least, kDelta * std::pow(now.violation, kSTheta) / std::pow(-slope, kSPhi));
  }
  if (kGammaAlpha * least > kRounding) return kGammaAlpha * least;
  for (std::size_t i = 0; i < model_.primal(); ++i)
    change = std::max(change, std::fabs(step.w[i]) / (1 + std::fabs(point.at.w[i])));
  return std::max(kGammaAlpha * least, kRounding / change);
}

LineSearch::Result LineSearch::search(Newton& newton, double mu, const Step& step, Point& point) {
  const Merit now = merit(point, mu);
  const double slope = this->slope(point, step), least = least_alpha(now, slope, point, step);
  Result result;
  result.alpha_dual = longest(step.reach.dual, mu);
  bool armijo = false, by_filter = false;
  for (double alpha = longest(step.reach.primal, mu); alpha > least || result.trials == 0;
       alpha /= 2) {
    ++result.trials;
    Merit trial{};
    const bool finite = try_step(point, step, alpha, mu, result.trials == 1, trial);
    result.faulted = !finite && model_.fault();
    if (finite && acceptable(now, trial, slope, alpha, armijo)) {
      result.accepted = true;
      result.alpha = alpha;
    } else if (finite && result.trials == 1 && trial.violation >= now.violation) {
      result.accepted = correct(newton, point, mu, step, now, slope, alpha, result, armijo);
    }
    if (!result.accepted) {
      by_filter = finite && progresses(now, trial, slope, alpha, armijo);
      continue;
    }
    note_blocked(by_filter, now);
    if (!armijo) filter_.add(now);
    std::swap(point.at.zl, trial_.at.zl);
    std::swap(point.at.zu, trial_.at.zu);
    std::swap(point, trial_);
    return result;
  }
  return result;
}

bool LineSearch::leap(double mu, const Step& step, Point& point, Result& result) {
  Merit ignored{};
  result.alpha = longest(step.reach.primal, mu);
  result.alpha_dual = longest(step.reach.dual, mu);
  if (!try_step(point, step, result.alpha, mu, true, ignored)) return false;
  std::swap(point.at.zl, trial_.at.zl);
  std::swap(point.at.zu, trial_.at.zu);
  std::swap(point, trial_);
  return true;
}

/// Second-order corrections (section 2.4): the step again with the rows' residuals at its end.
bool LineSearch::correct(Newton& newton, const Point& point, double mu, const Step& step,
                         const Merit& now, double slope, double alpha, Result& result,
                         bool& armijo) {
  double before = trial_.local.violation, length = alpha;
  residuals_ = point.local.residuals;
  for (int k = 0; k < kMaxCorrections; ++k) {
    ++result.corrections;
    for (std::size_t r = 0; r < residuals_.size(); ++r)
      residuals_[r] = length * residuals_[r] + trial_.local.residuals[r];
    if (!newton.step_for(point.e, point.local, point.at, mu, residuals_, corrected_)) return false;
    length = longest(corrected_.reach.primal, mu);
    corrected_.y = step.y;
    Merit trial{};
    if (!try_step(point, corrected_, length, mu, false, trial)) return false;
    if (acceptable(now, trial, slope, alpha, armijo)) {
      result.alpha = length;
      return true;
    }
    if (trial.violation > kKappaSoc * before) return false;
    before = trial.violation;
  }
  return false;
}

}  // namespace slalom::nlp::ipm
