#include "slalom/report/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "slalom/base/error.hpp"

namespace slalom::report {
namespace {

void require_counts(std::initializer_list<std::int64_t> counts, const char* where) {
  for (const auto count : counts)
    if (count < 0) throw InvalidValue(where, fmt::format("{}", count), "a count >= 0");
}

void require_confidence(double confidence, const char* where) {
  if (!(confidence > 0 && confidence < 1))
    throw InvalidValue(where, fmt::format("confidence {}", confidence), "a number between 0 and 1");
}

double log_choose(double n, double k) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

}  // namespace

Interval clopper_pearson(std::int64_t k, std::int64_t n, double confidence) {
  require_confidence(confidence, "clopper_pearson");
  if (n < 0 || k < 0 || k > n)
    throw InvalidValue("clopper_pearson", fmt::format("{} of {}", k, n), "0 <= k <= n");
  const double tail = (1 - confidence) / 2;
  const auto K = static_cast<double>(k), N = static_cast<double>(n);
  Interval interval{0, 1};
  if (k > 0) interval.lo = quantile(boost::math::beta_distribution<>(K, N - K + 1), tail);
  if (k < n)
    interval.hi = quantile(complement(boost::math::beta_distribution<>(K + 1, N - K), tail));
  return interval;
}

double fisher_exact(const Fourfold& t) {
  require_counts({t.passed1, t.failed1, t.passed2, t.failed2}, "fisher_exact");
  const auto n1 = static_cast<double>(t.passed1 + t.failed1);
  const auto n2 = static_cast<double>(t.passed2 + t.failed2);
  const auto k = static_cast<double>(t.passed1 + t.passed2);
  const double all = log_choose(n1 + n2, k);
  const auto log_probability = [&](double passed1) {
    return log_choose(n1, passed1) + log_choose(n2, k - passed1) - all;
  };
  // Equal probabilities differ by rounding: R's tolerance.
  const double own = log_probability(static_cast<double>(t.passed1)) + 1e-7;
  double p = 0;
  for (double x = std::max(0.0, k - n2); x <= std::min(k, n1); ++x)
    if (log_probability(x) <= own) p += std::exp(log_probability(x));
  return std::min(p, 1.0);
}

OddsRatio odds_ratio(const Fourfold& t, double confidence) {
  require_counts({t.passed1, t.failed1, t.passed2, t.failed2}, "odds_ratio");
  require_confidence(confidence, "odds_ratio");
  const bool zero = t.passed1 == 0 || t.failed1 == 0 || t.passed2 == 0 || t.failed2 == 0;
  const double add = zero ? 0.5 : 0;
  const double a = static_cast<double>(t.passed2) + add, b = static_cast<double>(t.failed2) + add;
  const double c = static_cast<double>(t.passed1) + add, d = static_cast<double>(t.failed1) + add;
  const double ratio = a * d / (b * c);
  const double z = quantile(boost::math::normal(), (1 + confidence) / 2);
  const double half = z * std::sqrt(1 / a + 1 / b + 1 / c + 1 / d);
  return {ratio, {ratio * std::exp(-half), ratio * std::exp(half)}};
}

double mcnemar_exact(std::int64_t only1, std::int64_t only2) {
  require_counts({only1, only2}, "mcnemar_exact");
  const auto n = static_cast<double>(only1 + only2);
  if (n == 0) return 1;
  const boost::math::binomial distribution(n, 0.5);
  return std::min(1.0, 2 * cdf(distribution, static_cast<double>(std::min(only1, only2))));
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= values.size()) return values.back();
  return values[below] + (at - static_cast<double>(below)) * (values[below + 1] - values[below]);
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace slalom::report
