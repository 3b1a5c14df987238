#include "multiplier_estimate.hpp"

#include <algorithm>

#include "newton.hpp"

namespace slalom::nlp::ipm {

MultiplierEstimate::MultiplierEstimate(const SlackForm& form, kkt::Backend& backend)
    : form_(form),
      backend_(backend),
      wanted_(inertia_of_minimum(form)),
      ones_(form.variables(), 1.0),
      no_hessian_(form.shape().hessian_row.size(), 0.0),
      no_flexibility_(form.equations().size(), 0.0),
      weight_(form.rows()),
      hessian_(form.condensed().places().size()),
      solution_(form.variables() + form.equations().size()),
      estimate_(form.rows()),
      force_(form.variables()),
      jd_(form.rows()) {
  for (std::size_t r = 0; r < form.rows(); ++r) weight_[r] = form.equation(r) ? 0 : 1;
}

/// The system  [I J'; J 0] (d, y) = (-gradient, 0)  with a unit weight on slacks too, condensed.
const std::vector<double>* MultiplierEstimate::operator()(const Point& point) {
  const Evaluation& e = point.functions();
  const Iterate& at = point.at();
  const std::size_t n = form_.variables();
  form_.condensed().sum(no_hessian_, e.jacobian, weight_, hessian_);
  if (backend_.factorize({hessian_, ones_, e.jacobian, no_flexibility_}) != wanted_) return nullptr;
  for (std::size_t r = 0; r < form_.rows(); ++r)
    estimate_[r] = form_.equation(r) ? 0 : at.zu[n + r] - at.zl[n + r];
  std::fill(force_.begin(), force_.end(), 0.0);
  form_.row_blocks().add_transposed(e.jacobian, estimate_, force_);
  std::fill(solution_.begin(), solution_.end(), 0.0);
  for (std::size_t i = 0; i < n; ++i)
    if (!form_.fixed(i)) solution_[i] = -(e.gradient[i] - at.zl[i] + at.zu[i] + force_[i]);
  backend_.solve(solution_);
  form_.row_blocks().multiply(e.jacobian, std::span(solution_).first(n), jd_);
  for (std::size_t r = 0; r < form_.rows(); ++r) estimate_[r] += weight_[r] * jd_[r];
  for (std::size_t k = 0; k < form_.equations().size(); ++k)
    estimate_[form_.equations()[k]] = solution_[n + k];
  return &estimate_;
}

}  // namespace slalom::nlp::ipm
