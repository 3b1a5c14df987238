#include "elastic_elimination.hpp"

namespace slalom::nlp::ipm {

void ElasticElimination::weigh(const BarrierTerms& terms) {
  for (std::size_t r = 0; r < form_.rows(); ++r) {
    give_[r] = 1 / terms.sigma[form_.p(r)] + 1 / terms.sigma[form_.n(r)];
    weight_[r] = form_.equation(r) ? 0 : 1 / (1 / terms.sigma[form_.slack(r)] + give_[r]);
  }
}

void ElasticElimination::add_curvature(std::span<double> diagonal) const {
  for (std::size_t i = 0; i < diagonal.size(); ++i) diagonal[i] += form_.curvature(i);
}

/// Right-hand sides of  sigma_p dp - dy = r_p  and  sigma_n dn + dy = r_n.
ElasticElimination::Pull ElasticElimination::pull(const BarrierTerms& terms, const Iterate& at,
                                                  std::size_t row) const {
  const double rho = form_.violation_weight();
  return {-(rho - at.y[row] + terms.slope[form_.p(row)]),
          -(rho + at.y[row] + terms.slope[form_.n(row)])};
}

/// b = -residual + r_p / sigma_p - r_n / sigma_n, and of an inequality (y - slope) / sigma_s. A row
/// without bounds has sigma_s = 0, no weight and no b.
void ElasticElimination::shift(const BarrierTerms& terms, const Iterate& at,
                               std::span<const double> residuals) {
  for (std::size_t r = 0; r < form_.rows(); ++r) {
    const auto [r_p, r_n] = pull(terms, at, r);
    const std::size_t s = form_.slack(r);
    b_[r] = -residuals[r] + r_p / terms.sigma[form_.p(r)] - r_n / terms.sigma[form_.n(r)];
    if (!form_.equation(r) && terms.sigma[s] > 0)
      b_[r] += (at.y[r] - terms.slope[s]) / terms.sigma[s];
    multipliers_[r] = at.y[r] - weight_[r] * b_[r];
  }
}

/// dy = (J dx - b) / F of an inequality,  ds = J dx + residual - dp + dn.
void ElasticElimination::recover(const BarrierTerms& terms, const Iterate& at,
                                 std::span<const double> residuals, std::span<const double> jdx,
                                 std::span<const double> equations_dy, Step& out) {
  for (std::size_t r = 0; r < form_.rows(); ++r) out.y[r] = weight_[r] * (jdx[r] - b_[r]);
  set_equations(equations_dy, out.y);
  for (std::size_t r = 0; r < form_.rows(); ++r) {
    const auto [r_p, r_n] = pull(terms, at, r);
    const std::size_t p = form_.p(r), n = form_.n(r);
    out.w[p] = (out.y[r] + r_p) / terms.sigma[p];
    out.w[n] = (r_n - out.y[r]) / terms.sigma[n];
    out.w[form_.slack(r)] = form_.equation(r) ? 0 : jdx[r] + residuals[r] - out.w[p] + out.w[n];
  }
}

void ElasticElimination::move_slacks(const BarrierTerms& terms, std::span<const double> jdx,
                                     std::span<const double> dy, Step& out) const {
  for (std::size_t r = 0; r < form_.rows(); ++r) {
    const double dp = dy[r] / terms.sigma[form_.p(r)];
    const double dn = -dy[r] / terms.sigma[form_.n(r)];
    out.w[form_.p(r)] += dp;
    out.w[form_.n(r)] += dn;
    if (!form_.equation(r)) out.w[form_.slack(r)] += jdx[r] + (dn - dp);
  }
}

void ElasticElimination::add_to_equations(const Step& step, std::span<double> left) const {
  for (std::size_t k = 0; k < form_.equations().size(); ++k) {
    const std::size_t r = form_.equations()[k];
    left[k] += step.w[form_.p(r)] - step.w[form_.n(r)];
  }
}

}  // namespace slalom::nlp::ipm
