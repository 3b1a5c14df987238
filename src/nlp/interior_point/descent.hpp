#pragma once

#include "barrier.hpp"
#include "line_search.hpp"
#include "multiplier_estimate.hpp"
#include "newton.hpp"
#include "point.hpp"
#include "slack_form.hpp"
#include "survey.hpp"

namespace slalom::nlp::ipm {

/// The iterations of the method on one form of a problem: on the problem itself, and on that of the
/// restoration phase. Beyond the steps of one iteration, in their order, it takes care that the
/// filter goes with the barrier parameter.
class Descent {
 public:
  /// `form` outlives this.
  explicit Descent(SlackForm& form);
  Descent(const Descent&) = delete;

  /// For a new solve, which is to depend on nothing from before. Of the barrier see Barrier::begin.
  void begin(BarrierRule rule, double mu, double least);
  /// Evaluates the first point, and takes the search's measures from its violation. False when a
  /// function is not finite.
  [[nodiscard]] bool start();

  // The parts of an iteration.
  /// Evaluates what is not known at the point. False when a function is not finite.
  [[nodiscard]] bool complete() { return point_.complete(); }
  /// Of the point, which is complete.
  void take_survey() { survey_ = surveyor_(point_); }
  /// Asks the barrier rule about the survey.
  void update_barrier();
  /// The Newton step at the point (complete). False: no regularisation gives one, or it gave up.
  [[nodiscard]] bool find_step();
  /// Searches along it. False: no step is acceptable, and the point is as it was.
  [[nodiscard]] bool take_step();
  /// Goes all along it, unsearched. False when that is not finite, and the point is as it was.
  [[nodiscard]] bool leap();
  /// Undoes them, and evaluates all again where they began: whoever leaps seldom goes back, and
  /// need not keep what was known there. False when a function is not finite.
  [[nodiscard]] bool go_back(const Iterate& from, const LineSearch::Result& last);

  /// mu / slack for every multiplier of a bound that is far from it.
  void centre_multipliers();
  /// Multipliers of the rows that fit the gradient best (Waechter & Biegler 2006, section 3.6);
  /// where that gives large ones, 0 for equations and those of the bounds for inequalities.
  void estimate_multipliers();

  // How good the point and a step are.
  Merit merit() const { return ipm::merit(point_, barrier_.mu()); }
  /// Of the barrier function along the step.
  double slope() const { return search_.slope(point_, terms_, step_); }
  /// Whether the search would accept the point after `before`, from where a step of `slope` and
  /// length `alpha` led; then it bars the way back.
  [[nodiscard]] bool pays(const Merit& before, double slope, double alpha);
  /// Whether the filter accepts it.
  bool accepts(const Merit& merit) const { return search_.filter().accepts(merit); }
  /// Bars the way back to the point and to worse ones.
  void bar() { search_.filter().add(merit()); }
  /// A step that changes no number by more than rounding.
  bool tiny_step() const;

  /// Asked during factorisations from now on; outlives this.
  void give_up_at(Deadline* deadline) { newton_.give_up_at(deadline); }
  /// Whether the last factorisation gave up.
  bool gave_up() const { return newton_.gave_up(); }

  const SlackForm& form() const { return form_; }
  const Point& point() const { return point_; }
  Point& point() { return point_; }
  const Step& step() const { return step_; }
  const Survey& survey() const { return survey_; }
  double dual_in_users_units() const { return surveyor_.dual_in_users_units(); }
  const Barrier& barrier() const { return barrier_; }
  const Newton& newton() const { return newton_; }
  const LineSearch::Result& last() const { return last_; }  ///< of the line searches

 private:
  void set_terms();
  bool predict();
  [[nodiscard]] bool corrected_step();
  void move_bound_multipliers();

  SlackForm& form_;
  Newton newton_;
  MultiplierEstimate estimate_;
  LineSearch search_;
  Surveyor surveyor_;
  Barrier barrier_;
  Point point_;
  BarrierTerms terms_;  ///< of the point, once a step is asked for
  Step step_, predictor_;
  std::vector<double> over_lower_, over_upper_;  ///< the predictor's products dw dz / slack
  Survey survey_;
  LineSearch::Result last_;
};

}  // namespace slalom::nlp::ipm
