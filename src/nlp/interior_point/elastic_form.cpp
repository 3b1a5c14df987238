#include "elastic_form.hpp"

#include <algorithm>
#include <cmath>

#include "elastic_elimination.hpp"

namespace slalom::nlp::ipm {

ElasticForm::ElasticForm(Problem& problem)
    : SlackForm(problem, 2 * problem.structure().rows),
      reference_(variables()),
      squared_scale_(variables()) {}

void ElasticForm::set_violation_weight(double rho) {
  rho_ = rho;
  objective_changed();
}

void ElasticForm::set_proximity_weight(double zeta) {
  zeta_ = zeta;
  objective_changed();
}

void ElasticForm::set_reference(std::span<const double> x) {
  for (std::size_t i = 0; i < variables(); ++i) {
    const double d = 1 / std::max(1.0, std::fabs(x[i]));
    reference_[i] = x[i];
    squared_scale_[i] = d * d;
  }
  objective_changed();
}

std::unique_ptr<RowElimination> ElasticForm::elimination() const {
  return std::make_unique<ElasticElimination>(*this);
}

/// The Hessian is the rows' alone: the objective's is diagonal, see curvature().
bool ElasticForm::evaluate(const Iterate& at, Parts parts, Evaluation& out) {
  if (!evaluate_functions(0, at, parts, out)) return false;
  if (parts.values) {
    out.objective = 0;
    for (std::size_t i = p(0); i < primal(); ++i) out.objective += rho_ * at.w[i];
    for (std::size_t i = 0; i < variables(); ++i) {
      const double away = at.w[i] - reference_[i];
      out.objective += 0.5 * curvature(i) * away * away;
    }
  }
  if (parts.derivatives)
    for (std::size_t i = 0; i < variables(); ++i)
      out.gradient[i] = curvature(i) * (at.w[i] - reference_[i]);
  return true;
}

/// g - s - p + n.
double ElasticForm::residuals(const Evaluation& e, std::span<const double> w,
                              std::span<double> out) const {
  SlackForm::residuals(e, w, out);
  for (std::size_t r = 0; r < rows(); ++r) out[r] -= w[p(r)] - w[n(r)];
  return vector_kernels().sum_magnitudes(rows(), out.data());
}

void ElasticForm::lagrangian_gradient(const Evaluation& e, std::span<const double> y,
                                      std::span<double> out) const {
  SlackForm::lagrangian_gradient(e, y, out);
  for (std::size_t r = 0; r < rows(); ++r) {
    out[p(r)] = rho_ - y[r];
    out[n(r)] = rho_ + y[r];
  }
}

double ElasticForm::derivative_along(const Evaluation& e, std::span<const double> slope,
                                     std::span<const double> dw) const {
  double sum = SlackForm::derivative_along(e, slope, dw);
  for (std::size_t i = p(0); i < primal(); ++i) sum += rho_ * dw[i];
  return sum;
}

}  // namespace slalom::nlp::ipm
