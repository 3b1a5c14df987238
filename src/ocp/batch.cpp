#include "batch.hpp"

#include <algorithm>
#include <cmath>

namespace slalom::ocp {
namespace {

bool all_finite(std::span<const double> numbers) {
  double sum = 0;  // 0 * finite is 0; 0 * inf and 0 * NaN are NaN
  for (double number : numbers) sum += 0 * number;
  return sum == 0;
}

std::size_t first_bad(std::span<const double> numbers) {
  const auto it =
      std::find_if_not(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
  return static_cast<std::size_t>(it - numbers.begin());
}

}  // namespace

void Batch::allocate() {
  x.resize(function.variables() * lanes);
  values.resize(function.outputs() * lanes);
  weights.resize(function.outputs() * lanes);
  jacobian.resize(function.jacobian_pattern().size() * lanes);
  hessian.resize(function.hessian_pattern().size() * lanes);
}

void Batch::load(std::span<const double> point) {
  for (std::size_t i = 0; i < function.variables(); ++i)
    for (std::size_t lane = 0; lane < lanes; ++lane)
      x[i * lanes + lane] = gather_scale[i] * point[gather[i * lanes + lane]];
}

void Batch::set_weights(double sigma, std::span<const double> y) {
  std::fill(weights.begin(), weights.end(), 0.0);
  for (const Scatter& s : to_rows) weights[s.source] += s.coefficient * y[s.target];
  for (const Scatter& s : to_terms) weights[s.source] += s.coefficient * sigma;
}

void Batch::run(nlp::Parts parts) {
  function.evaluate(
      lanes, x, data, weights,
      {.values = parts.values, .jacobian = parts.derivatives, .hessian = parts.hessian}, values,
      jacobian, hessian);
}

Batch::BadNumber Batch::find_bad_number(nlp::Parts parts) const {
  if (parts.values && !all_finite(values)) {
    const std::size_t bad = first_bad(values);
    return {true, bad / lanes, bad % lanes, ""};
  }
  if (parts.derivatives && !all_finite(jacobian)) {
    const std::size_t bad = first_bad(jacobian);
    const auto entry = function.jacobian_pattern()[bad / lanes];
    return {true, entry.row, bad % lanes, variables[entry.col]};
  }
  if (parts.hessian && !all_finite(hessian)) {
    const std::size_t bad = first_bad(hessian);
    const auto entry = function.hessian_pattern()[bad / lanes];
    return {true, 0, bad % lanes, variables[entry.row] + ", " + variables[entry.col]};
  }
  return {};
}

}  // namespace slalom::ocp
