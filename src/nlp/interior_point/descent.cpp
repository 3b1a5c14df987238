#include "descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slalom::nlp::ipm {
namespace {

constexpr double kKappaSigma = 1e10;  // Waechter & Biegler 2006, eq. 16
constexpr double kMostMultiplier = 1e3;
constexpr double kCentral = 10;  ///< multipliers within this factor of mu / slack are kept

}  // namespace

Descent::Descent(Problem& problem, const Elastic* elastic)
    : model(problem, elastic), newton(model), search(model), surveyor_(model) {
  point.resize(model);
  step.resize(model.primal(), model.rows());
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

bool Descent::find_step() {
  vector_kernels().barrier(model.segments(), point.local.bounded(model, point.at), barrier.mu(),
                           point.local.sigma.data(), point.local.slope.data());
  const double mu = barrier.mu();
  if (!newton.factorize(point.e, point.local, mu)) return false;
  const bool finite = newton.step(point.e, point.local, point.at, mu, step);
  if (finite && newton.accurate()) return true;
  return newton.factorize_as_singular(point.e, point.local, mu) &&
         newton.step(point.e, point.local, point.at, mu, step);
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
