#include "restoration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slalom::nlp::ipm {
namespace {

/// Weight of violation: W&B's when first called. At a floor mu, elastic parts of some mu / rho each
/// then hide whether the rows can be met, so that it is more when it is called again.
constexpr double kFirstWeight = 1e3, kLaterWeight = 1e4;
/// Of its own errors, in units of rho; and its least barrier parameter, for slacks of mu / rho are
/// to stay well above rounding.
constexpr double kTolerance = 1e-8, kLeastBarrier = 1e-6;

}  // namespace

Restoration::Restoration(Descent& main) : main_(main), inner_(main.model.problem(), &elastic_) {
  trial_.resize(main.model);
  elastic_.reference.resize(main.model.variables());
  elastic_.weight.resize(main.model.variables());
  misfits_.resize(main.model.rows());
}

void Restoration::refresh() {
  inner_.model.set_room(main_.model.room());
  inner_.model.refresh(main_.model.problem());
  inner_.model.set_scale(1, main_.model.row_scale());
}

/// Eq. 32, 33: p, n >= 0 that fit a row's residual (without them) and minimise their own barrier
/// function.
void Restoration::set_elastic_parts(double mu) {
  Iterate& at = inner_.point.at;
  const double rho = elastic_.rho;
  for (std::size_t r = 0; r < inner_.model.rows(); ++r) {
    const double c = misfits_[r];
    const double half = (mu - rho * c) / (2 * rho);
    const double least = 1e-12 * std::max(1.0, std::fabs(c));
    const double n = half + std::sqrt(half * half + mu * c / (2 * rho));
    const std::size_t ip = inner_.model.p(r), in = inner_.model.n(r);
    at.w[in] = std::max(n, least);
    at.w[ip] = std::max(c + n, least);
    at.zl[in] = mu / at.w[in];
    at.zl[ip] = mu / at.w[ip];
  }
}

void Restoration::begin() {
  const std::size_t n = main_.model.variables(), shared = main_.model.primal();
  Iterate& at = inner_.point.at;
  std::copy_n(main_.point.at.w.begin(), shared, at.w.begin());
  double mu = main_.barrier.mu();
  for (double residual : main_.point.local.residuals) mu = std::max(mu, std::fabs(residual));
  elastic_.zeta = std::sqrt(mu);
  for (std::size_t i = 0; i < n; ++i) {
    const double d = 1 / std::max(1.0, std::fabs(at.w[i]));
    elastic_.reference[i] = at.w[i];
    elastic_.weight[i] = d * d;
  }
  std::fill(at.y.begin(), at.y.end(), 0.0);
  for (std::size_t i = 0; i < shared; ++i) {
    at.zl[i] = std::min(elastic_.rho, main_.point.at.zl[i]);
    at.zu[i] = std::min(elastic_.rho, main_.point.at.zu[i]);
  }
  misfits_ = main_.point.local.residuals;
  set_elastic_parts(mu);
  inner_.newton.restart();
  inner_.barrier.begin(BarrierRule::monotone, mu, kLeastBarrier);
  inner_.point.have = {};
  inner_.point.measured = false;
}

/// Where no step is acceptable: the elastic parts anew, so that every row is met. The filter keeps
/// the search from coming back. False when they are met already.
bool Restoration::meet_rows() {
  Point& point = inner_.point;
  const double mu = inner_.barrier.mu();
  if (point.local.violation <= kTolerance) return false;
  inner_.search.filter().add(inner_.search.merit(point, mu));
  for (std::size_t r = 0; r < inner_.model.rows(); ++r)
    misfits_[r] =
        point.local.residuals[r] + point.at.w[inner_.model.p(r)] - point.at.w[inner_.model.n(r)];
  set_elastic_parts(mu);
  point.have = {};
  point.measured = false;
  return inner_.complete();
}

bool Restoration::accepted_by_main(double most_violation) {
  std::copy_n(inner_.point.at.w.begin(), main_.model.primal(), trial_.at.w.begin());
  trial_.have = {.values = true};
  if (!main_.model.evaluate(trial_.at, trial_.have, trial_.e)) return false;
  measure(main_.model, trial_);
  const Merit merit = main_.search.merit(trial_, main_.barrier.mu());
  return trial_.local.violation <= most_violation && main_.search.filter().accepts(merit);
}

/// The primal point back to the main method, with multipliers of bounds mu / slack where the old
/// ones are far from it, and the equations' afresh.
void Restoration::hand_back() {
  std::copy_n(inner_.point.at.w.begin(), main_.model.primal(), main_.point.at.w.begin());
  main_.point.have = {};
  main_.point.measured = false;
}

/// The weight of nearness falls with the barrier parameter (eq. 30): in the end violation alone
/// counts. False where the problem cannot be evaluated.
bool Restoration::update_barrier() {
  const double before = inner_.barrier.mu();
  inner_.update_barrier();
  if (inner_.barrier.mu() == before) return true;
  elastic_.zeta = std::sqrt(inner_.barrier.mu());
  inner_.point.have.values = inner_.point.have.derivatives = false;
  return inner_.complete();
}

Restoration::Outcome Restoration::run(Watch& watch, double most_violation, bool again) {
  elastic_.rho = again ? kLaterWeight : kFirstWeight;
  begin();
  if (!inner_.complete()) return Outcome::failed;
  inner_.search.reset(inner_.point.local.violation);
  for (;;) {
    if (watch.stop()) return Outcome::stopped;
    inner_.take_survey();
    if (inner_.barrier.at_least() && inner_.survey.primal <= kTolerance &&
        inner_.survey.error(kLeastBarrier) <= kTolerance * elastic_.rho) {
      hand_back();
      return Outcome::infeasible;
    }
    if (!update_barrier()) return Outcome::failed;
    if (!inner_.find_step()) return inner_.newton.gave_up() ? Outcome::stopped : Outcome::failed;
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
