#pragma once

#include <span>
#include <vector>

#include "slack_form.hpp"

namespace slalom::nlp::ipm {

/// An iterate with what is known of it. Whatever changes a part of the iterate, or what its form
/// evaluates to, lets go of what was known of that part. The functions are evaluated when asked
/// for, as that can fail; the rest follows from them by itself when it is read.
class Point {
 public:
  explicit Point(SlackForm& form);

  const Iterate& at() const { return at_; }
  /// For writing w; nothing is known afterwards.
  std::span<double> change_w();
  /// For writing the rows' slacks, of which the functions know nothing.
  std::span<double> change_slacks();
  /// For writing the rows' multipliers; the Hessian is known no more.
  std::span<double> change_y();
  /// For writing the bounds' multipliers, on which nothing here depends.
  std::span<double> change_zl() { return at_.zl; }
  std::span<double> change_zu() { return at_.zu; }
  /// Becomes w and y of `from` and so much of the step; multipliers of bounds stay.
  void set_along(const Point& from, const Step& step, double alpha, double alpha_y);
  /// Becomes `at`.
  void set(const Iterate& at);
  /// Swaps with a point all but the multipliers of bounds.
  void swap_all_but_bounds(Point& other);

  /// Evaluates these parts anew. False when a function is not finite.
  [[nodiscard]] bool evaluate(Parts parts);
  /// Evaluates what of these is not known.
  [[nodiscard]] bool complete(Parts wanted = {
                                  .values = true, .derivatives = true, .hessian = true});
  /// Takes over the form's scales. The functions here were evaluated with all of them 1, and
  /// without the Hessian.
  void scale_functions();
  /// The functions here, as far as they are known.
  const Evaluation& functions() const { return e_; }

  /// Of the rows; these two need the functions' values.
  std::span<const double> residuals() const;
  double violation() const;  ///< their 1-norm
  /// Sum of the logarithms of all slacks; -infinity unless all are positive.
  double log_slacks() const;
  /// What the loops over bounds read, with 1 / slack.
  BoundedVector bounded() const;

 private:
  Parts known() const;
  BoundedVector bounded_with(const std::vector<double>& over_lower,
                             const std::vector<double>& over_upper) const;
  void forget_slacks() const;
  void forget_old_slacks() const;
  void find_residuals() const;

  SlackForm* form_;
  Iterate at_;
  Evaluation e_;
  Parts evaluated_;  ///< of at_, at revision_ of the form
  SlackForm::Revision revision_;

  mutable std::uint64_t slacks_revision_ = 0;  ///< of the form, for what stands below
  mutable bool residuals_known_ = false, logs_known_ = false, reciprocals_known_ = false;
  mutable std::vector<double> residuals_;
  mutable double violation_ = 0, logs_ = 0;
  mutable std::vector<double> over_lower_, over_upper_;  ///< 1 / slack of each bound of w
};

/// f - mu sum of the logarithms of all slacks; infinity unless all are positive.
double barrier_function(const Point& point, double mu);

}  // namespace slalom::nlp::ipm
