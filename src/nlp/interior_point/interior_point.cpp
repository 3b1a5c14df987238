// A primal-dual interior-point method with filter line search for stage-structured programs
// (Waechter & Biegler, Math. Program. 106, 2006), ending at a barrier floor where one is asked for.

#include <algorithm>
#include <cmath>
#include <optional>

#include "../backends.hpp"
#include "line_search.hpp"
#include "model.hpp"
#include "newton.hpp"
#include "restoration.hpp"
#include "slalom/base/timer.hpp"

namespace slalom::nlp {
namespace {

using namespace ipm;

constexpr double kBarrierTolerance = 10, kFirstBarrier = 0.1, kBoundPush = 1e-2;

/// A value inside its bounds by an absolute and a relative distance (section 3.6).
double inside(double value, double lower, double upper, double push) {
  const bool has_lower = std::isfinite(lower), has_upper = std::isfinite(upper);
  if (has_lower) {
    double room = push * std::max(1.0, std::fabs(lower));
    if (has_upper) room = std::min(room, push * (upper - lower));
    value = std::max(value, lower + room);
  }
  if (has_upper) {
    double room = push * std::max(1.0, std::fabs(upper));
    if (has_lower) room = std::min(room, push * (upper - lower));
    value = std::min(value, upper - room);
  }
  return value;
}

class Run {
 public:
  Run(Problem& problem, const Options& options)
      : options_(options), model_(problem), newton_(model_), search_(model_) {
    at_.resize(model_.variables(), model_.rows());
    step_.resize(model_.variables(), model_.rows());
  }

  Answer solve(const Start& start) {
    mu_ = options_.floor > 0 ? options_.floor : kFirstBarrier;
    begin(start);
    const Status status = iterate();
    return answer(status);
  }

 private:
  // --- start -------------------------------------------------------------------------------
  void begin(const Start& start) {
    const Limits& limits = model_.limits();
    const double push = options_.warm_start ? 1e-6 : kBoundPush;
    for (std::size_t i = 0; i < model_.variables(); ++i)
      at_.x[i] =
          model_.fixed(i) ? limits.xl[i] : inside(start.x[i], limits.xl[i], limits.xu[i], push);
    if (!model_.values(at_, e_)) return;
    const bool dual = options_.warm_start && start.y.size() == model_.rows();
    for (std::size_t i = 0; i < model_.variables(); ++i) {
      if (model_.fixed(i)) continue;
      at_.zl[i] = multiplier(at_.x[i] - limits.xl[i], dual ? start.zl[i] : 0);
      at_.zu[i] = multiplier(limits.xu[i] - at_.x[i], dual ? start.zu[i] : 0);
    }
    for (std::size_t r = 0; r < model_.rows(); ++r) {
      at_.y[r] = dual ? start.y[r] : 0;
      if (model_.equation(r)) continue;
      // A slack is its row's value, but no closer to the bound than its multiplier would hold it.
      const double least_l = dual && start.y[r] < 0 ? 0.1 * mu_ / -start.y[r] : push;
      const double least_u = dual && start.y[r] > 0 ? 0.1 * mu_ / start.y[r] : push;
      at_.s[r] = inside(e_.rows[r], limits.gl[r], limits.gu[r], push);
      if (std::isfinite(limits.gl[r]) && !std::isfinite(limits.gu[r]))
        at_.s[r] = std::max(at_.s[r], limits.gl[r] + least_l);
      if (std::isfinite(limits.gu[r]) && !std::isfinite(limits.gl[r]))
        at_.s[r] = std::min(at_.s[r], limits.gu[r] - least_u);
      at_.vl[r] = multiplier(at_.s[r] - limits.gl[r], dual ? std::max(-start.y[r], 0.0) : 0);
      at_.vu[r] = multiplier(limits.gu[r] - at_.s[r], dual ? std::max(start.y[r], 0.0) : 0);
      if (!dual) at_.y[r] = at_.vu[r] - at_.vl[r];
    }
  }

  /// The given multiplier or mu / slack, whichever is more central; 0 for an absent bound.
  double multiplier(double slack, double given) const {
    if (!std::isfinite(slack)) return 0;
    const double ratio = slack * given / mu_;
    return ratio > 0.1 && ratio < 10 ? given : mu_ / slack;
  }

  // --- main loop ---------------------------------------------------------------------------
  Status iterate() {
    if (!model_.derivatives(at_, e_)) return Status::invalid_number;
    search_.reset(model_.violation(e_, at_));
    for (iterations_ = 0;; ++iterations_) {
      if (converged()) return Status::solved;
      if (iterations_ >= options_.max_iterations) return Status::iteration_limit;
      if (out_of_time()) return Status::time_limit;
      if (told_to_stop()) return Status::interrupted;
      update_barrier();
      if (!model_.hessian(at_, e_)) return Status::invalid_number;
      if (!newton_.factorize(e_, at_, mu_)) return Status::numerical_failure;
      newton_.step(e_, at_, mu_, step_);
      const auto result = search_.search(newton_, mu_, step_, e_, at_);
      if (result.accepted) {
        advance_duals(model_, step_, result.alpha, result.alpha_dual, mu_, at_);
      } else if (const auto status = restore()) {
        return *status;
      }
      if (!model_.derivatives(at_, e_)) return Status::invalid_number;
    }
  }

  bool converged() const {
    if (options_.floor > 0) {
      if (mu_ > options_.floor) return false;
      const auto r = model_.residuals(e_, at_, mu_);
      return r.dual <= options_.dual_tol && r.primal <= options_.constraint_tol &&
             r.centrality <= options_.floor_tol;
    }
    return scaled_error(model_, e_, at_, 0) <= options_.tol;
  }

  /// Monotone rule (eq. 7), never below the floor.
  void update_barrier() {
    const double least = options_.floor > 0 ? options_.floor : options_.tol / 10;
    while (mu_ > least && scaled_error(model_, e_, at_, mu_) <= kBarrierTolerance * mu_) {
      mu_ = next_barrier(mu_, least);
      search_.new_barrier();
    }
  }

  bool out_of_time() const { return timer_.wall() > options_.time_limit; }
  bool told_to_stop() const {
    return options_.stop != nullptr && options_.stop(options_.stop_data);
  }

  /// When no step is acceptable: less violation first, then on. Empty: go on.
  std::optional<Status> restore() {
    const double violation = model_.violation(e_, at_);
    if (violation <= options_.constraint_tol * 1e-2) return Status::numerical_failure;
    search_.filter().add(violation, model_.barrier(e_, at_, mu_));
    if (!restoration_) restoration_.emplace(model_.problem());
    Iterate trial;
    Evaluation values;
    trial.resize(model_.variables(), model_.rows());
    const auto accept = [&](const std::vector<double>& x, const std::vector<double>& s) {
      trial.x = x;
      trial.s = s;
      if (!model_.values(trial, values)) return false;
      const double now = model_.violation(values, trial);
      return now <= 0.9 * violation &&
             search_.filter().accepts(now, model_.barrier(values, trial, mu_));
    };
    const auto outcome = restoration_->run(mu_, at_, iterations_, options_.max_iterations, accept,
                                           [&] { return out_of_time() || told_to_stop(); });
    model_.values(at_, e_);
    switch (outcome) {
      case Restoration::Outcome::infeasible:
        return Status::infeasible;
      case Restoration::Outcome::failed:
        return Status::numerical_failure;
      case Restoration::Outcome::stopped:
        if (out_of_time()) return Status::time_limit;
        return iterations_ >= options_.max_iterations ? Status::iteration_limit
                                                      : Status::interrupted;
      case Restoration::Outcome::restored:
        break;
    }
    central_multipliers();
    return std::nullopt;
  }

  /// mu / slack for every bound, and the rows' multipliers that go with them.
  void central_multipliers() {
    const Limits& limits = model_.limits();
    for (std::size_t i = 0; i < model_.variables(); ++i) {
      if (model_.fixed(i)) continue;
      at_.zl[i] = multiplier(at_.x[i] - limits.xl[i], at_.zl[i]);
      at_.zu[i] = multiplier(limits.xu[i] - at_.x[i], at_.zu[i]);
    }
    for (std::size_t r = 0; r < model_.rows(); ++r) {
      if (model_.equation(r)) {
        at_.y[r] = 0;
        continue;
      }
      at_.vl[r] = multiplier(at_.s[r] - limits.gl[r], at_.vl[r]);
      at_.vu[r] = multiplier(limits.gu[r] - at_.s[r], at_.vu[r]);
      at_.y[r] = at_.vu[r] - at_.vl[r];
    }
  }

  Answer answer(Status status) {
    Answer answer;
    answer.status = status;
    answer.backend = "interior_point/" + newton_.backend().name();
    if (status == Status::invalid_number) answer.fault = model_.fault();
    answer.point = {at_.x, at_.y, at_.zl, at_.zu};
    answer.objective = e_.objective;
    answer.iterations = iterations_;
    answer.cpu_s = timer_.cpu();
    answer.wall_s = timer_.wall();
    return answer;
  }

  const Options& options_;
  Timer timer_;
  Model model_;
  Newton newton_;
  LineSearch search_;
  std::optional<Restoration> restoration_;
  Iterate at_;
  Step step_;
  Evaluation e_;
  double mu_ = 0;
  int iterations_ = 0;
};

class InteriorPoint final : public Solver {
 public:
  Answer solve(Problem& problem, const Start& start, const Options& options) override {
    return Run(problem, options).solve(start);
  }
};

}  // namespace

std::unique_ptr<Solver> make_interior_point() {
  return std::make_unique<InteriorPoint>();
}

}  // namespace slalom::nlp
