#include "descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slalom::nlp::ipm {
namespace {

constexpr double kKappaSigma = 1e10;  // Waechter & Biegler 2006, eq. 16
constexpr double kMostMultiplier = 1e3;
constexpr double kFar = 0.5;     ///< of a predictor's steps, for its second-order terms to count
constexpr double kCentral = 10;  ///< multipliers within this factor of mu / slack are kept

double longest_within(double reach) {
  return reach > 1 ? 1 / reach : 1;
}

}  // namespace

Descent::Descent(Problem& problem, const Elastic* elastic)
    : model(problem, elastic), newton(model), search(model), surveyor_(model) {
  point.resize(model);
  step.resize(model.primal(), model.rows());
  predictor_.resize(model.primal(), model.rows());
  over_lower_.resize(model.primal());
  over_upper_.resize(model.primal());
}

bool Descent::complete() {
  const Parts missing{!point.have.values, !point.have.derivatives, !point.have.hessian};
  if (missing.values || missing.derivatives || missing.hessian) {
    if (!model.evaluate(point.at, missing, point.e)) return false;
    point.have = {true, true, true};
  }
  if (!point.measured) measure(model, point);
  return true;
}

void Descent::update_barrier() {
  if (barrier.update(survey)) search.filter().clear();
}

/// Sigma, and the slope at the barrier's mu, of the point.
void Descent::set_barrier_terms() {
  vector_kernels().barrier(model.segments(), point.local.bounded(model, point.at), barrier.mu(),
                           point.local.sigma.data(), point.local.slope.data());
}

bool Descent::find_step() {
  set_barrier_terms();
  if (!newton.factorize(point.e, point.local, barrier.mu())) return false;
  if (barrier.free() && survey.mean_product > 0 && predict() && corrected_step()) return true;
  const double mu = barrier.mu();
  const bool finite = newton.step(point.e, point.local, point.at, mu, step);
  if (finite && newton.accurate()) return true;
  return newton.factorize_as_singular(point.e, point.local, mu) &&
         newton.step(point.e, point.local, point.at, mu, step);
}

/// Mu by how far a step towards mu = 0 gets, where it gets far; what that step adds to the products
/// beyond first order is then known too (Mehrotra, SIAM J. Optim. 2(4), 1992).
bool Descent::predict() {
  const auto& kernels = vector_kernels();
  const BoundedVector bounded = point.local.bounded(model, point.at);
  std::fill(point.local.slope.begin(), point.local.slope.end(), 0.0);
  bool far = newton.step(point.e, point.local, point.at, 0, predictor_);
  const double primal = longest_within(predictor_.reach.primal),
               dual = longest_within(predictor_.reach.dual);
  far = far && std::min(primal, dual) >= kFar;
  if (far) {
    const double sum =
        kernels.products_after(model.segments(), bounded, primal, dual, predictor_.w.data(),
                               predictor_.zl.data(), predictor_.zu.data());
    barrier.follow_predictor(survey.mean_product, sum / survey.bounds);
  } else {
    barrier.follow_spread(survey);
  }
  search.filter().clear();
  set_barrier_terms();
  return far;
}

/// The step towards mu less the second-order terms of the predictor.
bool Descent::corrected_step() {
  const auto& kernels = vector_kernels();
  const BoundedVector bounded = point.local.bounded(model, point.at);
  kernels.second_order(model.segments(), bounded, predictor_.w.data(), predictor_.zl.data(),
                       predictor_.zu.data(), over_lower_.data(), over_upper_.data(),
                       point.local.slope.data());
  const bool finite = newton.step(point.e, point.local, point.at, barrier.mu(), step);
  step.reach = kernels.correct_duals(model.segments(), bounded, step.w.data(), over_lower_.data(),
                                     over_upper_.data(), step.zl.data(), step.zu.data());
  set_barrier_terms();
  return finite && newton.accurate() && std::isfinite(step.reach.primal + step.reach.dual);
}

bool Descent::take_step() {
  last = search.search(newton, barrier.mu(), step, point);
  if (last.accepted) move_duals();
  return last.accepted;
}

bool Descent::leap() {
  last = {};
  if (!search.leap(barrier.mu(), step, point, last)) return false;
  move_duals();
  return true;
}

void Descent::move_duals() {
  vector_kernels().reciprocals(model.segments(), point.local.bounded(model, point.at),
                               point.local.over_lower.data(), point.local.over_upper.data());
  vector_kernels().move_duals(model.segments(), point.local.bounded(model, point.at), barrier.mu(),
                              last.alpha_dual, kKappaSigma, step.zl.data(), step.zu.data(),
                              point.at.zl.data(), point.at.zu.data());
  point.measured = true;  // the line search has done the rest
}

bool Descent::tiny_step() const {
  constexpr double kTiny = 10 * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < model.primal(); ++i)
    if (std::fabs(step.w[i]) > kTiny * (1 + std::fabs(point.at.w[i]))) return false;
  return true;
}

void Descent::centre_multipliers(double mu) {
  const auto central = [mu](double slack, double z) {
    const double ratio = slack * z / mu;
    return ratio > 1 / kCentral && ratio < kCentral ? z : mu / slack;
  };
  Iterate& at = point.at;
  for (std::size_t k = 0; k < model.segments().count; ++k) {
    const Segment& s = model.segments().first[k];
    for (std::size_t i = s.begin; i < s.end; ++i) {
      if (s.lower) at.zl[i] = central(at.w[i] - model.lower()[i], at.zl[i]);
      if (s.upper) at.zu[i] = central(model.upper()[i] - at.w[i], at.zu[i]);
    }
  }
}

void Descent::estimate_multipliers() {
  Iterate& at = point.at;
  const std::size_t n = model.variables();
  for (std::size_t r = 0; r < model.rows(); ++r)
    at.y[r] = model.equation(r) ? 0 : at.zu[n + r] - at.zl[n + r];
  if (model.equations().empty() || !newton.fit_multipliers(point.e, at, step)) return;
  double largest = 0;
  for (const auto r : model.equations()) largest = std::max(largest, std::fabs(step.y[r]));
  if (largest <= kMostMultiplier) std::copy(step.y.begin(), step.y.end(), at.y.begin());
}

}  // namespace slalom::nlp::ipm
