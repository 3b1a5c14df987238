#include "watchdog.hpp"

namespace slalom::nlp::ipm {
namespace {

constexpr int kShortenedSteps = 5, kLeaps = 3, kFirstLeaps = 8, kSoftSteps = 10;
constexpr int kMostFailed = 2;
constexpr double kFeasible = 1e-4;  ///< violation with which restoration has nothing to do
constexpr double kSoftProgress = 0.9999;

}  // namespace

void Watchdog::restart(bool close) {
  leaps_ = softened_ = failed_ = 0;
  shortened_ = close ? kShortenedSteps : 0;
  most_leaps_ = close ? kFirstLeaps : kLeaps;
}

void Watchdog::end_leaps() {
  leaps_ = 0;
  most_leaps_ = kLeaps;
}

Watchdog::Outcome Watchdog::advance(Descent& descent) {
  if (leaps_ > 0 && descent.barrier().mu() != mu_) end_leaps();  // another problem by now
  if (leaps_ > 0) return leap(descent);
  if (shortened_ < kShortenedSteps) return search(descent);
  shortened_ = 0;
  mu_ = descent.barrier().mu();
  from_ = descent.point().at();
  merit_ = descent.merit();
  slope_ = descent.slope();
  return leap(descent);
}

Watchdog::Outcome Watchdog::search(Descent& descent) {
  if (!descent.take_step()) return soften(descent) ? Outcome::moved : Outcome::stuck;
  softened_ = 0;
  shortened_ = descent.last().trials > 1 ? shortened_ + 1 : 0;
  if (shortened_ == 0) failed_ = 0;
  return Outcome::moved;
}

/// The longest step of both kinds of variables, if the primal-dual error falls.
bool Watchdog::soften(Descent& descent) {
  if (softened_ >= kSoftSteps) return false;
  const double mu = descent.barrier().mu();
  const auto error = [&] {
    const Survey& s = descent.survey();
    return s.dual + s.primal + s.complementarity(mu);
  };
  const double before = error();
  const LineSearch::Result searched = descent.last();
  from_ = descent.point().at();
  if (descent.leap() && descent.complete()) {
    descent.take_survey();
    if (error() <= kSoftProgress * before) {
      ++softened_;
      return true;
    }
  }
  if (descent.go_back(from_, searched)) descent.take_survey();
  return false;
}

Watchdog::Outcome Watchdog::leap(Descent& descent) {
  ++leaps_;
  if (!descent.leap()) return go_back(descent);
  if (leaps_ == 1) alpha_ = descent.last().alpha;
  if (descent.pays(merit_, slope_, alpha_)) {
    end_leaps();
    failed_ = 0;
  } else if (leaps_ >= most_leaps_) {
    return go_back(descent);
  }
  return Outcome::moved;
}

Watchdog::Outcome Watchdog::go_back(Descent& descent) {
  end_leaps();
  ++failed_;
  // The factorisation is of another point by now: without second-order corrections of this step.
  if (!descent.go_back(from_, descent.last()) || !descent.find_step()) return Outcome::stuck;
  if (failed_ >= kMostFailed && descent.point().violation() > kFeasible) return Outcome::stuck;
  return search(descent);
}

}  // namespace slalom::nlp::ipm
