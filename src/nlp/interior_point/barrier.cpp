#include "barrier.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::nlp::ipm {
namespace {

constexpr double kTolerance = 10, kFactor = 0.2, kPower = 1.5;  // Waechter & Biegler 2006, sec. 4
constexpr double kProgress = 0.9999, kHold = 0.8;               // Nocedal et al. 2009, section 4

}  // namespace

void Barrier::begin(BarrierRule rule, double mu, double least) {
  least_ = least;
  mu_ = std::max(mu, least);
  adaptive_ = free_ = rule == BarrierRule::adaptive && mu > least;
  noted_ = 0;
}

bool Barrier::set(double mu) {
  mu = std::max(mu, least_);
  if (mu == mu_) return false;
  mu_ = mu;
  return true;
}

bool Barrier::update(const Survey& survey) {
  return free_ ? update_free(survey) : update_monotone(survey);
}

bool Barrier::update_monotone(const Survey& survey) {
  bool changed = false;
  while (mu_ > least_ && survey.error(mu_) <= kTolerance * mu_) {
    if (adaptive_) {
      free_ = true;
      noted_ = 0;
      return update_free(survey) || changed;
    }
    changed = set(std::min(kFactor * mu_, std::pow(mu_, kPower))) || changed;
  }
  return changed;
}

bool Barrier::update_free(const Survey& survey) {
  if (!(survey.mean_product > 0)) return set(least_);
  const double error = survey.error(0);
  const std::size_t known = std::min(noted_, errors_.size());
  if (known > 0 &&
      error > kProgress * *std::max_element(errors_.begin(), errors_.begin() + known) &&
      known == errors_.size()) {
    free_ = false;
    return set(kHold * survey.mean_product);
  }
  errors_[noted_++ % errors_.size()] = error;
  return false;
}

void Barrier::follow_predictor(double mean, double mean_after) {
  const double ratio = mean_after / mean;
  set(std::min(1.0, ratio * ratio * ratio) * mean);
}

void Barrier::follow_spread(const Survey& survey) {
  const double mean = survey.mean_product, spread = survey.least_product / mean;
  const double sigma = 0.1 * std::pow(std::min(0.05 * (1 - spread) / spread, 2.0), 3);
  set(sigma * mean);
}

}  // namespace slalom::nlp::ipm
