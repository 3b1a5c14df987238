#pragma once

#include <vector>

#include "barrier_terms.hpp"
#include "filter.hpp"
#include "newton.hpp"
#include "point.hpp"

namespace slalom::nlp::ipm {

/// Fraction to the boundary rule (Waechter & Biegler 2006, eq. 8).
double boundary_fraction(double mu);

/// Of a point whose values are known.
Merit merit(const Point& point, double mu);

/// Backtracking along a step by the filter, with second-order corrections (Waechter & Biegler 2006,
/// Algorithm A, step A-5).
class LineSearch {
 public:
  explicit LineSearch(SlackForm& form);

  /// For a new problem.
  void reset(double violation_at_start);
  Filter& filter() { return filter_; }
  const Filter& filter() const { return filter_; }

  struct Result {
    bool accepted = false;
    double alpha = 0, alpha_dual = 0;
    int trials = 0;
    int corrections = 0;  ///< second-order corrections tried
    Fault fault = {};     ///< that the last trial met
  };
  /// Along a step found with `terms`. On acceptance `point` is the new iterate, its multipliers y
  /// moved, those of bounds not yet. The first trial evaluates derivatives too, for it is mostly
  /// accepted.
  Result search(Newton& newton, const BarrierTerms& terms, const Step& step, Point& point);
  /// The longest step without asking the filter: for the watchdog. False when it is not finite.
  [[nodiscard]] bool leap(double mu, const Step& step, Point& point, Result& result);
  /// Whether `trial` is good enough after `now`, from where a step of slope `slope` led there.
  bool acceptable(const Merit& now, const Merit& trial, double slope, double alpha) const;
  /// For when it was: bars the way back to `now`, unless the barrier function fell enough by
  /// itself.
  void leave(const Merit& now, double slope, double alpha);
  /// Of the barrier function along the step.
  double slope(const Point& point, const BarrierTerms& terms, const Step& step) const;

 private:
  /// A search under way: from where, and its slope.
  struct Origin {
    const Point& point;
    const BarrierTerms& terms;
    const Step& step;
    Merit merit;
    double slope;
  };
  bool progresses(const Merit& now, const Merit& trial, double slope, double alpha) const;
  bool armijo(const Merit& now, double slope, double alpha) const;
  void note_blocked(bool by_filter, const Merit& now);
  bool try_step(const Point& from, const Step& step, double alpha, double mu, bool derivatives,
                Merit& merit);
  bool correct(Newton& newton, const Origin& from, double alpha, Result& result);
  double least_alpha(const Origin& from) const;

  SlackForm& form_;
  Filter filter_;
  double most_violation_ = 0, small_violation_ = 0;
  int blocked_ = 0;  ///< searches in a row whose step the filter alone shortened
  Point trial_;
  Step corrected_;
  std::vector<double> residuals_;  ///< that a second-order correction is for
};

}  // namespace slalom::nlp::ipm
