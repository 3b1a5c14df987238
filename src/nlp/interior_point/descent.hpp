#pragma once

#include "barrier.hpp"
#include "line_search.hpp"
#include "model.hpp"
#include "newton.hpp"
#include "survey.hpp"

namespace slalom::nlp::ipm {

/// The parts of the method that both the problem itself and its restoration phase are solved with,
/// and one iteration of it.
class Descent {
 public:
  explicit Descent(Problem& problem, const Elastic* elastic = nullptr);
  Descent(const Descent&) = delete;

  Model model;
  Newton newton;
  LineSearch search;
  Barrier barrier;
  Point point;
  Step step;
  Survey survey;
  LineSearch::Result last;  ///< of the last line search

  /// Evaluates what is missing at the point. False when a function is not finite.
  [[nodiscard]] bool complete();
  void take_survey() { survey = surveyor_(point); }
  /// Asks the barrier rule; a new parameter starts the filter anew.
  void update_barrier();

  /// The Newton step at the point (complete). False: no regularisation gives one.
  [[nodiscard]] bool find_step();
  /// Searches along it. False: no step is acceptable, and the point is as it was.
  [[nodiscard]] bool take_step();
  /// Goes all along it, unsearched. False when that is not finite.
  [[nodiscard]] bool leap();
  /// A step that changes no number by more than rounding.
  bool tiny_step() const;

  /// mu / slack for every multiplier of a bound that is far from it.
  void centre_multipliers(double mu);
  /// Multipliers of the rows that fit the gradient best (Waechter & Biegler 2006, section 3.6);
  /// where that gives large ones, 0 for equations and those of the bounds for inequalities.
  void estimate_multipliers();

 private:
  void move_duals();
  void set_barrier_terms();
  bool predict();
  [[nodiscard]] bool corrected_step();

  Surveyor surveyor_;
  Step predictor_;
  std::vector<double> over_lower_, over_upper_;  ///< its products dw dz / slack
};

}  // namespace slalom::nlp::ipm
