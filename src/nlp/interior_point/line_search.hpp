#pragma once

#include <vector>

#include "filter.hpp"
#include "model.hpp"
#include "newton.hpp"

namespace slalom::nlp::ipm {

/// An iterate with all that is known of it.
struct Point {
  Iterate at;
  Evaluation e;
  Parts have;             ///< which parts of e are of this iterate
  bool measured = false;  ///< local's reciprocals, residuals and the logarithms are too
  double logs = 0;        ///< sum of the logarithms of all slacks
  Local local;            ///< sigma and slope are of the iterate once a step is asked for

  void resize(const Model& model);
};

/// Fraction to the boundary rule (Waechter & Biegler 2006, eq. 8).
double boundary_fraction(double mu);

/// Fills what a point holds of its slacks and residuals.
void measure(const Model& model, Point& point);
/// f - mu sum of the logarithms of all slacks; infinity unless all are positive.
double barrier_function(const Point& point, double mu);

/// Backtracking along a step by the filter, with second-order corrections (Waechter & Biegler 2006,
/// Algorithm A, step A-5).
class LineSearch {
 public:
  explicit LineSearch(Model& model);

  /// For a new problem.
  void reset(double violation_at_start);
  Filter& filter() { return filter_; }

  struct Result {
    bool accepted = false;
    double alpha = 0, alpha_dual = 0;
    int trials = 0;
    int corrections = 0;   ///< second-order corrections tried
    bool faulted = false;  ///< the last trial met a number that is not finite
  };
  /// On acceptance `point` is the new iterate, its multipliers y moved, those of bounds not yet.
  /// The first trial evaluates derivatives too, for it is mostly accepted.
  Result search(Newton& newton, double mu, const Step& step, Point& point);
  /// The longest step without asking the filter: for the watchdog. False when it is not finite.
  [[nodiscard]] bool leap(double mu, const Step& step, Point& point, Result& result);
  Merit merit(const Point& point, double mu) const;
  /// Whether `trial` is good enough after `now`, from where a step of slope `slope` led there.
  bool acceptable(const Merit& now, const Merit& trial, double slope, double alpha, bool& armijo);
  double slope(const Point& point, const Step& step) const;

 private:
  bool progresses(const Merit& now, const Merit& trial, double slope, double alpha,
                  bool& armijo) const;
  void note_blocked(bool by_filter, const Merit& now);
  bool try_step(const Point& from, const Step& step, double alpha, double mu, bool derivatives,
                Merit& merit);
  bool correct(Newton& newton, const Point& point, double mu, const Step& step, const Merit& now,
               double slope, double alpha, Result& result, bool& armijo);
  double least_alpha(const Merit& now, double slope, const Point& point, const Step& step) const;

  Model& model_;
  Filter filter_;
  double most_violation_ = 0, small_violation_ = 0;
  int blocked_ = 0;  ///< searches on end whose step the filter alone shortened
  Point trial_;
  Step corrected_;
  std::vector<double> residuals_;
};

}  // namespace slalom::nlp::ipm
