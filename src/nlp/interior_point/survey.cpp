#include "survey.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::nlp::ipm {
namespace {

constexpr double kMostMean = 100;  // s_max of Waechter & Biegler 2006, eq. 5

double scale(double sum, std::size_t count) {
  return std::max(kMostMean, sum / static_cast<double>(std::max<std::size_t>(count, 1))) /
         kMostMean;
}

}  // namespace

double Survey::complementarity(double mu) const {
  return bounded ? std::max({most_product - mu, mu - least_product, 0.0}) : 0;
}

double Survey::error(double mu) const {
  return std::max({dual / dual_scale, primal, complementarity(mu) / product_scale});
}

Surveyor::Surveyor(const Model& model) : model_(model), slope_(model.primal()) {}

Survey Surveyor::operator()(const Point& point) {
  const auto& kernels = vector_kernels();
  const std::size_t n = model_.variables(), m = model_.rows();
  const Iterate& at = point.at;
  std::copy(point.e.gradient.begin(), point.e.gradient.end(), slope_.begin());
  model_.row_blocks().add_transposed(point.e.jacobian, at.y, std::span(slope_).first(n));
  for (std::size_t r = 0; r < m; ++r) slope_[n + r] = -at.y[r];
  if (const Elastic* elastic = model_.elastic())
    for (std::size_t r = 0; r < m; ++r) {
      slope_[model_.p(r)] = elastic->rho - at.y[r];
      slope_[model_.n(r)] = elastic->rho + at.y[r];
    }
  kernels.combine(slope_.size(), slope_.data(), -1, at.zl.data(), slope_.data());
  kernels.combine(slope_.size(), slope_.data(), 1, at.zu.data(), slope_.data());
  for (std::size_t i = 0; i < n; ++i)
    if (model_.fixed(i)) slope_[i] = 0;
  for (const auto r : model_.equations()) slope_[n + r] = 0;

  Survey survey;
  survey.dual = kernels.largest_magnitude(slope_.size(), slope_.data());
  survey.primal = kernels.largest_magnitude(m, point.local.residuals.data());
  const auto products =
      kernels.complementarity(model_.segments(), point.local.bounded(model_, at), 0);
  std::size_t bounds = 0;
  for (std::size_t k = 0; k < model_.segments().count; ++k) {
    const Segment& s = model_.segments().first[k];
    bounds += (s.end - s.begin) * ((s.lower ? 1u : 0u) + (s.upper ? 1u : 0u));
  }
  if (bounds > 0) {
    survey.bounded = true;
    survey.bounds = static_cast<double>(bounds);
    survey.least_product = products.least;
    survey.most_product = products.most;
    survey.mean_product = products.sum / static_cast<double>(bounds);
  }
  const double z = kernels.sum_magnitudes(at.zl.size(), at.zl.data()) +
                   kernels.sum_magnitudes(at.zu.size(), at.zu.data());
  survey.dual_scale = scale(z + kernels.sum_magnitudes(m, at.y.data()), bounds + m);
  survey.product_scale = scale(z, bounds);
  return survey;
}

}  // namespace slalom::nlp::ipm
