#include "row_elimination.hpp"

#include <algorithm>

namespace slalom::nlp::ipm {

RowElimination::RowElimination(const SlackForm& form) : form_(form) {
  for (auto* list : {&weight_, &give_, &b_, &multipliers_, &dy_}) list->assign(form.rows(), 0.0);
}

void RowElimination::set_equations(std::span<const double> values, std::span<double> by_row) const {
  for (std::size_t k = 0; k < form_.equations().size(); ++k)
    by_row[form_.equations()[k]] = values[k];
}

void RowElimination::correct(const BarrierTerms& terms, std::span<const double> jdx,
                             std::span<const double> equations_dy, Step& out) {
  for (std::size_t r = 0; r < dy_.size(); ++r) dy_[r] = weight_[r] * jdx[r];
  set_equations(equations_dy, dy_);
  for (std::size_t r = 0; r < dy_.size(); ++r) out.y[r] += dy_[r];
  move_slacks(terms, jdx, dy_, out);
}

/// F = 1 / sigma of the slack; sigma is 0 of an equation's.
void SlackElimination::weigh(const BarrierTerms& terms) {
  std::copy_n(terms.sigma.data() + form_.variables(), form_.rows(), weight_.data());
}

/// b = -residual + (y - slope) / sigma, so that y - b / F = sigma residual + slope.
void SlackElimination::shift(const BarrierTerms& terms, const Iterate& at,
                             std::span<const double> residuals) {
  vector_kernels().multiply_add(form_.rows(), weight_.data(), residuals.data(),
                                terms.slope.data() + form_.variables(), multipliers_.data());
  for (const auto r : form_.equations()) {
    multipliers_[r] = at.y[r];
    b_[r] = -residuals[r];
  }
}

/// ds = J dx + residual,  dy = sigma ds + slope - y.
void SlackElimination::recover(const BarrierTerms& terms, const Iterate& at,
                               std::span<const double> residuals, std::span<const double> jdx,
                               std::span<const double> equations_dy, Step& out) {
  const auto& kernels = vector_kernels();
  const std::size_t n = form_.variables(), m = form_.rows();
  double* ds = out.w.data() + n;
  kernels.combine(m, jdx.data(), 1, residuals.data(), ds);
  kernels.multiply_add(m, weight_.data(), ds, terms.slope.data() + n, out.y.data());
  kernels.combine(m, out.y.data(), -1, at.y.data(), out.y.data());
  for (const auto r : form_.equations()) ds[r] = 0;
  set_equations(equations_dy, out.y);
}

void SlackElimination::move_slacks(const BarrierTerms&, std::span<const double> jdx,
                                   std::span<const double>, Step& out) const {
  for (std::size_t r = 0; r < form_.rows(); ++r)
    if (!form_.equation(r)) out.w[form_.slack(r)] += jdx[r];
}

}  // namespace slalom::nlp::ipm
