#include "restoration.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slalom::nlp::ipm {
namespace {

/// Weight of violation: W&B's when first called. At a floor mu, elastic parts of some mu / rho each
/// then hide whether the rows can be met, so that it is more when it is called again.
constexpr double kFirstWeight = 1e3, kLaterWeight = 1e4;
/// Of its own errors, in units of rho; and its least barrier parameter, for slacks of mu / rho are
/// to stay well above rounding.
constexpr double kTolerance = 1e-8, kLeastBarrier = 1e-6;

/// The entries of w that the main form has, too.
void copy_primal(const Point& elastic, Point& point) {
  const auto w = point.change_w();
  std::copy_n(elastic.at().w.begin(), w.size(), w.begin());
}

}  // namespace

Restoration::Restoration(SlackForm& form, Descent& main)
    : main_(main),
      form_(form.problem()),
      inner_(form_),
      misfits_(form.rows()),
      force_(form.variables()),
      trial_(form) {}

/// With its limits and scales, which may be others than at the last run.
void Restoration::take_over_problem() {
  form_.set_room(main_.form().room());
  form_.refresh(main_.form().problem());
  form_.set_scale(1, main_.form().row_scale());
}

/// Eq. 32, 33: p, n >= 0 that fit a row's residual (without them) and minimise their own barrier
/// function.
void Restoration::set_elastic_parts(double mu) {
  Point& point = inner_.point();
  const auto w = point.change_w(), zl = point.change_zl();
  const double rho = form_.violation_weight();
  for (std::size_t r = 0; r < form_.rows(); ++r) {
    const double c = misfits_[r];
    const double half = (mu - rho * c) / (2 * rho);
    const double least = 1e-12 * std::max(1.0, std::fabs(c));
    const double n = half + std::sqrt(half * half + mu * c / (2 * rho));
    const std::size_t ip = form_.p(r), in = form_.n(r);
    w[in] = std::max(n, least);
    w[ip] = std::max(c + n, least);
    zl[in] = mu / w[in];
    zl[ip] = mu / w[ip];
  }
}

/// From where the main method is. False where the problem cannot be evaluated.
bool Restoration::begin() {
  const Iterate& from = main_.point().at();
  Point& point = inner_.point();
  const auto residuals = main_.point().residuals();
  double mu = main_.barrier().mu();
  for (double residual : residuals) mu = std::max(mu, std::fabs(residual));
  form_.set_proximity_weight(std::sqrt(mu));
  form_.set_reference(from.w);
  const auto w = point.change_w(), y = point.change_y(), zl = point.change_zl(),
             zu = point.change_zu();
  for (std::size_t i = 0; i < from.w.size(); ++i) {
    w[i] = from.w[i];
    zl[i] = std::min(form_.violation_weight(), from.zl[i]);
    zu[i] = std::min(form_.violation_weight(), from.zu[i]);
  }
  std::fill(y.begin(), y.end(), 0.0);
  std::copy(residuals.begin(), residuals.end(), misfits_.begin());
  set_elastic_parts(mu);
  inner_.begin(BarrierRule::monotone, mu, kLeastBarrier);
  return inner_.start();
}

/// Where no step is acceptable: the elastic parts anew, so that every row is met. The filter keeps
/// the search from coming back. False when they are met already, or cannot be evaluated.
bool Restoration::meet_rows() {
  const Point& point = inner_.point();
  if (point.violation() <= kTolerance) return false;
  inner_.bar();
  const std::vector<double>& w = point.at().w;
  for (std::size_t r = 0; r < form_.rows(); ++r)
    misfits_[r] = point.residuals()[r] + w[form_.p(r)] - w[form_.n(r)];
  set_elastic_parts(inner_.barrier().mu());
  return inner_.complete();
}

bool Restoration::accepted_by_main(double most_violation) {
  copy_primal(inner_.point(), trial_);
  return trial_.evaluate({.values = true}) && trial_.violation() <= most_violation &&
         main_.accepts(merit(trial_, main_.barrier().mu()));
}

void Restoration::hand_back() {
  copy_primal(inner_.point(), main_.point());
}

void Restoration::hand_back_multipliers() {
  const Iterate& at = inner_.point().at();
  Point& point = main_.point();
  double violation = 0;
  for (std::size_t r = 0; r < form_.rows(); ++r) violation += at.w[form_.p(r)] + at.w[form_.n(r)];
  // Without the objective's scale, by which what is handed out is divided.
  const double factor = main_.form().objective_scale() / (form_.violation_weight() * violation);
  const auto y = point.change_y(), zl = point.change_zl(), zu = point.change_zu();
  for (std::size_t r = 0; r < form_.rows(); ++r) y[r] = factor * at.y[r];
  std::fill(force_.begin(), force_.end(), 0.0);
  form_.row_blocks().add_transposed(point.functions().jacobian, y, force_);
  for (std::size_t i = 0; i < form_.variables(); ++i) {
    // The bounds of a fixed variable have no terms of their own: what holds it balances the rows.
    zl[i] = form_.fixed(i) ? std::max(force_[i], 0.0) : factor * at.zl[i];
    zu[i] = form_.fixed(i) ? std::max(-force_[i], 0.0) : factor * at.zu[i];
  }
}

/// The weight of nearness falls with the barrier parameter (eq. 30): in the end violation alone
/// counts. False where the problem cannot be evaluated.
bool Restoration::update_barrier() {
  const double before = inner_.barrier().mu();
  inner_.update_barrier();
  const double mu = inner_.barrier().mu();
  if (mu != before) form_.set_proximity_weight(std::sqrt(mu));
  return inner_.complete();
}

/// Whether violation is least here, and not zero.
bool Restoration::at_least_violation() const {
  return inner_.barrier().at_least() && inner_.survey().primal <= kTolerance &&
         inner_.survey().error(kLeastBarrier) <= kTolerance * form_.violation_weight();
}

Restoration::Outcome Restoration::run(Watch& watch, double most_violation, bool again) {
  take_over_problem();
  form_.set_violation_weight(again ? kLaterWeight : kFirstWeight);
  if (!begin()) return Outcome::failed;
  for (;;) {
    if (watch.stop()) return Outcome::stopped;
    inner_.take_survey();
    if (at_least_violation()) {
      hand_back();
      return Outcome::infeasible;
    }
    if (!update_barrier()) return Outcome::failed;
    if (!inner_.find_step()) return inner_.gave_up() ? Outcome::stopped : Outcome::failed;
    if (!inner_.take_step() && !meet_rows()) return Outcome::failed;
    watch.iterated(inner_);
    if (accepted_by_main(most_violation)) {
      hand_back();
      return Outcome::restored;
    }
    if (!inner_.complete()) return Outcome::failed;
  }
}

}  // namespace slalom::nlp::ipm
