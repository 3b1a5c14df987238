#pragma once

#include <utility>
#include <vector>

#include "model.hpp"
#include "newton.hpp"

namespace slalom::nlp::ipm {

/// The filter: pairs of violation and barrier function that a new iterate must improve on
/// (Waechter & Biegler 2006, section 2.3).
class Filter {
 public:
  void reset(double most_violation);
  bool accepts(double violation, double barrier) const;
  void add(double violation, double barrier);

 private:
  double most_violation_ = 0;
  std::vector<std::pair<double, double>> entries_;
};

/// Largest step to keep a share 1 - tau of the distance to every bound (eq. 15).
double most_primal(const Model& model, const Iterate& at, const Step& step, double tau);
double most_dual(const Model& model, const Iterate& at, const Step& step, double tau);

/// Backtracking along a step by the filter, with second-order corrections (Algorithm A, step A-5).
class LineSearch {
 public:
  explicit LineSearch(Model& model);

  void reset(double violation_at_start);
  /// Forgets the filter: for a new barrier parameter.
  void new_barrier() { filter_.reset(most_violation_); }
  Filter& filter() { return filter_; }

  struct Result {
    bool accepted = false;
    double alpha = 0, alpha_dual = 0;
    int trials = 0;
    int corrections = 0;  ///< second-order corrections tried
  };
  /// On acceptance `at` and `e` (values only) are the new iterate's.
  Result search(Newton& newton, double mu, const Step& step, Evaluation& e, Iterate& at);

 private:
  struct Merit {
    double violation, barrier;
  };
  bool trial(const Iterate& at, const Step& step, double alpha, double mu, Merit& merit);
  bool acceptable(const Merit& now, const Merit& trial, double slope, double alpha, bool& armijo);
  bool correct(Newton& newton, const Evaluation& e, const Iterate& at, double mu, const Merit& now,
               double slope, double alpha, double tau, Result& result);

  Model& model_;
  Filter filter_;
  double most_violation_ = 0, small_violation_ = 0;
  Iterate trial_;
  Evaluation trial_values_;
  Step corrected_;
  std::vector<double> residuals_;
};

}  // namespace slalom::nlp::ipm
