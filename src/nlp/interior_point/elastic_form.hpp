#pragma once

#include "slack_form.hpp"

namespace slalom::nlp::ipm {

/// The problem of the restoration phase (Waechter & Biegler 2006, eq. 30): rows relaxed by elastic
/// parts p, n >= 0, and nearness to a reference point in place of f,
///
///   min rho sum(p + n) + zeta/2 sum (D_i (x_i - reference_i))^2
///   s.t. g(x) - s - p + n = 0,   wl <= w <= wu,   w = (x, s, p, n),   D_i = 1 / max(1,
///   |reference|).
class ElasticForm final : public SlackForm {
 public:
  explicit ElasticForm(Problem& problem);
  std::size_t p(std::size_t r) const { return variables() + rows() + r; }
  std::size_t n(std::size_t r) const { return variables() + 2 * rows() + r; }

  /// rho, the weight of violation.
  double violation_weight() const { return rho_; }
  void set_violation_weight(double rho);
  /// zeta, the weight of nearness.
  void set_proximity_weight(double zeta);
  void set_reference(std::span<const double> x);
  /// Second derivative of the objective by x_i.
  double curvature(std::size_t i) const { return zeta_ * squared_scale_[i]; }

  std::unique_ptr<RowElimination> elimination() const override;
  [[nodiscard]] bool evaluate(const Iterate& at, Parts parts, Evaluation& out) override;
  double residuals(const Evaluation& e, std::span<const double> w,
                   std::span<double> out) const override;
  void lagrangian_gradient(const Evaluation& e, std::span<const double> y,
                           std::span<double> out) const override;
  double derivative_along(const Evaluation& e, std::span<const double> slope,
                          std::span<const double> dw) const override;

 private:
  double rho_ = 0, zeta_ = 0;
  std::vector<double> reference_, squared_scale_;  ///< by variable; D_i^2
};

}  // namespace slalom::nlp::ipm
