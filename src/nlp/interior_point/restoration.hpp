#pragma once

#include <algorithm>
#include <cmath>
#include "line_search.hpp"
#include "model.hpp"
#include "newton.hpp"

namespace slalom::nlp::ipm {

/// New multipliers along a step, kept within reach of mu / slack (Waechter & Biegler 2006, eq. 16).
void advance_duals(const Model& model, const Step& step, double alpha, double alpha_dual, double mu,
                   Iterate& at);

/// Optimality error at mu with the multipliers' size divided out (eq. 5).
double scaled_error(const Model& model, const Evaluation& e, const Iterate& at, double mu);

/// The least barrier parameter reached by the monotone rule (eq. 7) from mu, not below `least`.
double next_barrier(double mu, double least);

/// The feasibility restoration phase (section 3.3): from a point where no step is acceptable to one
/// that the filter accepts with less violation, by minimising the rows' elastic parts on the same
/// stage structure.
class Restoration {
 public:
  explicit Restoration(Problem& problem);

  enum class Outcome { restored, infeasible, failed, stopped };
  /// `accept(x, s)` says whether the main method can go on from there; `stop()` ends early.
  /// On `restored` and `infeasible`, x and s of `at` are the point reached.
  template <class Accept, class Stop>
  Outcome run(double mu, Iterate& at, int& iterations, int most_iterations, Accept accept,
              Stop stop);

 private:
  /// Sets the elastic start; returns its barrier parameter, the largest residual or mu.
  double begin(double mu, const Iterate& from);

  Elastic elastic_;
  Model model_;
  Newton newton_;
  LineSearch search_;
  Iterate at_;
  Step step_;
  Evaluation e_;
};

template <class Accept, class Stop>
Restoration::Outcome Restoration::run(double mu, Iterate& at, int& iterations, int most_iterations,
                                      Accept accept, Stop stop) {
  mu = begin(mu, at);
  if (!model_.derivatives(at_, e_)) return Outcome::failed;
  search_.reset(model_.violation(e_, at_));
  for (; iterations < most_iterations; ++iterations) {
    if (stop()) return Outcome::stopped;
    const bool at_optimum = scaled_error(model_, e_, at_, 0) <= 1e-8;
    if (at_optimum) {
      at.x = at_.x;
      at.s = at_.s;
      return Outcome::infeasible;
    }
    while (mu > 1e-9 && scaled_error(model_, e_, at_, mu) <= 10 * mu) {
      mu = next_barrier(mu, 1e-9);
      search_.new_barrier();
    }
    if (!model_.hessian(at_, e_) || !newton_.factorize(e_, at_, mu)) return Outcome::failed;
    newton_.step(e_, at_, mu, step_);
    const auto result = search_.search(newton_, mu, step_, e_, at_);
    if (!result.accepted) return Outcome::failed;
    advance_duals(model_, step_, result.alpha, result.alpha_dual, mu, at_);
    if (accept(at_.x, at_.s)) {
      at.x = at_.x;
      at.s = at_.s;
      ++iterations;
      return Outcome::restored;
    }
    if (!model_.derivatives(at_, e_)) return Outcome::failed;
  }
  return Outcome::stopped;
}

}  // namespace slalom::nlp::ipm
