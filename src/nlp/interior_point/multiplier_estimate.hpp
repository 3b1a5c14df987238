#pragma once

#include <span>
#include <vector>

#include "point.hpp"
#include "slalom/kkt/system.hpp"

namespace slalom::nlp::ipm {

/// Multipliers of the rows that fit the gradient best: the least
/// |grad f + J' y - zl + zu| over variables and slacks (Waechter & Biegler 2006, section 3.6), from
/// the same factorisation as the Newton step with 1 in place of the Hessian.
class MultiplierEstimate {
 public:
  /// Factorises with a backend made for the form's pattern, whose own factorisation it overwrites.
  MultiplierEstimate(const SlackForm& form, kkt::Backend& backend);
  /// At a point whose derivatives and multipliers of bounds are known; nullptr when the rows depend
  /// on each other. By row.
  const std::vector<double>* operator()(const Point& point);

 private:
  const SlackForm& form_;
  kkt::Backend& backend_;
  const kkt::Inertia wanted_;
  const std::vector<double> ones_, no_hessian_, no_flexibility_;
  std::vector<double> weight_;  ///< by row: 1 of an inequality, whose slack it is; 0 of an equation
  std::vector<double> hessian_;   ///< 0, with the inequalities condensed onto it
  std::vector<double> solution_;  ///< of the condensed system: -(what is left), then y
  std::vector<double> estimate_;  ///< by row
  std::vector<double> force_,
      jd_;  ///< J' (multipliers of slacks), by variable; J times what is left
};

}  // namespace slalom::nlp::ipm
