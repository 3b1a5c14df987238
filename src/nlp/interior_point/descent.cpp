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

Descent::Descent(SlackForm& form)
    : form_(form),
      newton_(form),
      estimate_(form, newton_.backend()),
      search_(form),
      surveyor_(form),
      point_(form),
      over_lower_(form.primal()),
      over_upper_(form.primal()) {
  for (auto* list : {&terms_.sigma, &terms_.slope}) list->resize(form.primal());
  for (auto* one : {&step_, &predictor_}) one->resize(form.primal(), form.rows());
}

void Descent::begin(BarrierRule rule, double mu, double least) {
  barrier_.begin(rule, mu, least);
  newton_.restart();
  search_.filter().clear();
}

bool Descent::start() {
  if (!complete()) return false;
  search_.reset(point_.violation());
  return true;
}

void Descent::update_barrier() {
  if (barrier_.update(survey_)) search_.filter().clear();
}

void Descent::set_terms() {
  terms_.mu = barrier_.mu();
  vector_kernels().barrier(form_.segments(), point_.bounded(), terms_.mu, terms_.sigma.data(),
                           terms_.slope.data());
}

bool Descent::find_step() {
  set_terms();
  if (!newton_.factorize(point_, terms_)) return false;
  if (barrier_.free() && survey_.mean_product > 0 && predict() && corrected_step()) return true;
  const bool finite = newton_.step(point_, terms_, step_);
  if (finite && newton_.accurate()) return true;
  return newton_.factorize_as_singular(point_, terms_) && newton_.step(point_, terms_, step_);
}

/// Mu by how far a step towards mu = 0 gets, where it gets far; what that step adds to the products
/// beyond first order is then known too (Mehrotra, SIAM J. Optim. 2(4), 1992).
bool Descent::predict() {
  terms_.mu = 0;
  std::fill(terms_.slope.begin(), terms_.slope.end(), 0.0);
  bool far = newton_.step(point_, terms_, predictor_);
  const double primal = longest_within(predictor_.reach.primal),
               dual = longest_within(predictor_.reach.dual);
  far = far && std::min(primal, dual) >= kFar;
  if (far) {
    const double sum = vector_kernels().products_after(form_.segments(), point_.bounded(), primal,
                                                       dual, predictor_.w.data(),
                                                       predictor_.zl.data(), predictor_.zu.data());
    barrier_.follow_predictor(survey_.mean_product, sum / survey_.bounds);
  } else {
    barrier_.follow_spread(survey_);
  }
  search_.filter().clear();
  set_terms();
  return far;
}

/// The step towards mu less the second-order terms of the predictor.
bool Descent::corrected_step() {
  const auto& kernels = vector_kernels();
  kernels.second_order(form_.segments(), point_.bounded(), predictor_.w.data(),
                       predictor_.zl.data(), predictor_.zu.data(), over_lower_.data(),
                       over_upper_.data(), terms_.slope.data());
  const bool finite = newton_.step(point_, terms_, step_);
  step_.reach =
      kernels.correct_duals(form_.segments(), point_.bounded(), step_.w.data(), over_lower_.data(),
                            over_upper_.data(), step_.zl.data(), step_.zu.data());
  set_terms();
  return finite && newton_.accurate() && std::isfinite(step_.reach.primal + step_.reach.dual);
}

bool Descent::take_step() {
  last_ = search_.search(newton_, terms_, step_, point_);
  if (last_.accepted) move_bound_multipliers();
  return last_.accepted;
}

bool Descent::leap() {
  last_ = {};
  if (!search_.leap(barrier_.mu(), step_, point_, last_)) return false;
  move_bound_multipliers();
  return true;
}

bool Descent::go_back(const Iterate& from, const LineSearch::Result& last) {
  point_.set(from);
  last_ = last;
  return complete();
}

void Descent::move_bound_multipliers() {
  vector_kernels().move_duals(form_.segments(), point_.bounded(), barrier_.mu(), last_.alpha_dual,
                              kKappaSigma, step_.zl.data(), step_.zu.data(),
                              point_.change_zl().data(), point_.change_zu().data());
}

bool Descent::pays(const Merit& before, double slope, double alpha) {
  if (!search_.acceptable(before, merit(), slope, alpha)) return false;
  search_.leave(before, slope, alpha);
  return true;
}

bool Descent::tiny_step() const {
  constexpr double kTiny = 10 * std::numeric_limits<double>::epsilon();
  const std::vector<double>& w = point_.at().w;
  for (std::size_t i = 0; i < w.size(); ++i)
    if (std::fabs(step_.w[i]) > kTiny * (1 + std::fabs(w[i]))) return false;
  return true;
}

void Descent::centre_multipliers() {
  const double mu = barrier_.mu();
  const auto central = [mu](double slack, double z) {
    const double ratio = slack * z / mu;
    return ratio > 1 / kCentral && ratio < kCentral ? z : mu / slack;
  };
  const std::vector<double>& w = point_.at().w;
  const auto zl = point_.change_zl(), zu = point_.change_zu();
  for (std::size_t k = 0; k < form_.segments().count; ++k) {
    const Segment& s = form_.segments().first[k];
    for (std::size_t i = s.begin; i < s.end; ++i) {
      if (s.lower) zl[i] = central(w[i] - form_.lower()[i], zl[i]);
      if (s.upper) zu[i] = central(form_.upper()[i] - w[i], zu[i]);
    }
  }
}

void Descent::estimate_multipliers() {
  const Iterate& at = point_.at();
  const auto y = point_.change_y();
  const std::size_t n = form_.variables();
  for (std::size_t r = 0; r < form_.rows(); ++r)
    y[r] = form_.equation(r) ? 0 : at.zu[n + r] - at.zl[n + r];
  if (form_.equations().empty()) return;
  const std::vector<double>* fit = estimate_(point_);
  if (fit == nullptr) return;
  double largest = 0;
  for (const auto r : form_.equations()) largest = std::max(largest, std::fabs((*fit)[r]));
  if (largest <= kMostMultiplier) std::copy(fit->begin(), fit->end(), y.begin());
}

}  // namespace slalom::nlp::ipm
