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

Surveyor::Surveyor(const SlackForm& form) : form_(form), gradient_(form.primal()) {}

Survey Surveyor::operator()(const Point& point) {
  const auto& kernels = vector_kernels();
  const std::size_t m = form_.rows();
  const Iterate& at = point.at();
  form_.lagrangian_gradient(point.functions(), at.y, gradient_);
  kernels.combine(gradient_.size(), gradient_.data(), -1, at.zl.data(), gradient_.data());
  kernels.combine(gradient_.size(), gradient_.data(), 1, at.zu.data(), gradient_.data());
  for (std::size_t i = 0; i < form_.variables(); ++i)
    if (form_.fixed(i)) gradient_[i] = 0;
  for (const auto r : form_.equations()) gradient_[form_.slack(r)] = 0;

  Survey survey;
  survey.dual = kernels.largest_magnitude(gradient_.size(), gradient_.data());
  survey.primal = kernels.largest_magnitude(m, point.residuals().data());
  const auto products = kernels.complementarity(form_.segments(), point.bounded(), 0);
  std::size_t bounds = 0;
  for (std::size_t k = 0; k < form_.segments().count; ++k) {
    const Segment& s = form_.segments().first[k];
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

double Surveyor::dual_in_users_units() const {
  double most = 0;
  for (std::size_t i = 0; i < form_.variables(); ++i)
    most = std::max(most, std::fabs(gradient_[i]) / form_.shape().variable_scale[i]);
  return most;
}

}  // namespace slalom::nlp::ipm
