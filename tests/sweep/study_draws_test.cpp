#include "../../src/sweep/study_draws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

#include "slalom/base/error.hpp"

namespace slalom::sweep {
namespace {

using Points = std::vector<std::vector<double>>;

/// A distribution with the text it refers to.
struct Read {
  std::unique_ptr<io::Value> map;
  Distribution distribution;
};

Read distribution(const std::string& text) {
  Read read;
  read.map = std::make_unique<io::Value>(io::parse_text(text, "draw.yaml", "a draw"));
  read.distribution = read_distribution(*read.map);
  return read;
}

double number(const Read& read, double u) {
  return read.distribution.quantile(u);
}

/// How often coordinate `i` falls into each of `n` equal intervals.
std::vector<int> counts(const Points& points, std::size_t i, int n) {
  std::vector<int> count(static_cast<std::size_t>(n));
  for (const auto& p : points) ++count.at(static_cast<std::size_t>(p[i] * n));
  return count;
}

/// Greatest distance between the values' empirical distribution and `cdf`, times sqrt(n).
double kolmogorov(std::vector<double> values, const std::function<double(double)>& cdf) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double most = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    most = std::max({most, std::abs(cdf(values[k]) - static_cast<double>(k) / n),
                     std::abs(cdf(values[k]) - static_cast<double>(k + 1) / n)});
  return most * std::sqrt(n);
}

TEST(UnitPoints, LieWithinTheCubeAndFollowSeedAndStream) {
  for (const auto sampling : {Sampling::random, Sampling::latin_hypercube, Sampling::sobol}) {
    const auto points = unit_points(sampling, 300, 4, 1, 0);
    for (const auto& point : points)
      for (const double u : point) EXPECT_TRUE(u > 0 && u < 1);
    EXPECT_EQ(points, unit_points(sampling, 300, 4, 1, 0));
    EXPECT_NE(points, unit_points(sampling, 300, 4, 2, 0));
    EXPECT_NE(points, unit_points(sampling, 300, 4, 1, 1));
    EXPECT_EQ(std::set(points.begin(), points.end()).size(), 300U);
  }
}

TEST(UnitPoints, MorePointsLeaveTheFirstOnesButInALatinHypercube) {
  for (const auto sampling : {Sampling::random, Sampling::sobol}) {
    const auto many = unit_points(sampling, 100, 3, 1, 0), few = unit_points(sampling, 7, 3, 1, 0);
    EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  }
}

TEST(UnitPoints, ALatinHypercubeHasOnePointInEachIntervalOfEachEdge) {
  const auto points = unit_points(Sampling::latin_hypercube, 137, 5, 3, 0);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(counts(points, i, 137), std::vector<int>(137, 1)) << i;
  // The edges are not in step with each other.
  EXPECT_NE(points[0][0], points[0][1]);
  int rising = 0;
  for (std::size_t k = 1; k < points.size(); ++k) rising += points[k][0] > points[k - 1][0];
  EXPECT_TRUE(rising > 40 && rising < 96) << rising;
}

TEST(UnitPoints, SobolsFirstPowersOfTwoAreNets) {
  // Each edge by itself holds one point in each interval, and the first two edges together one in
  // each box of area 1/64, whatever its shape: a (0, 6, 2)-net, which shifts leave one.
  for (const int seed : {0, 1, 17}) {
    const auto points = unit_points(Sampling::sobol, 64, 50, seed, 0);
    for (std::size_t i = 0; i < 50; ++i)
      EXPECT_EQ(counts(points, i, 64), std::vector<int>(64, 1)) << i;
    for (int a = 0; a <= 6; ++a) {
      std::set<std::pair<int, int>> boxes;
      for (const auto& p : points)
        boxes.insert({static_cast<int>(p[0] * (1 << a)), static_cast<int>(p[1] * (64 >> a))});
      EXPECT_EQ(boxes.size(), 64U) << a;
    }
  }
}

TEST(UnitPoints, SobolIntegratesASmoothFunctionFarBetterThanChance) {
  // The product of 1 + (u - 1/2) / 2 over six edges has the mean 1.
  const auto error = [](Sampling sampling) {
    double sum = 0;
    for (const auto& p : unit_points(sampling, 4096, 6, 5, 0)) {
      double product = 1;
      for (const double u : p) product *= 1 + (u - 0.5) / 2;
      sum += product;
    }
    return std::abs(sum / 4096 - 1);
  };
  EXPECT_LT(error(Sampling::sobol), 5e-4);
  EXPECT_LT(error(Sampling::latin_hypercube), 3e-3);
}

TEST(UnitPoints, SobolHasAStatedLimitOfKeys) {
  EXPECT_EQ(max_sobol_dimension(), 3667U);
  EXPECT_EQ(unit_points(Sampling::sobol, 2, max_sobol_dimension(), 0, 0)[1].size(), 3667U);
}

TEST(Distributions, HaveTheQuantilesOfTheirNames) {
  EXPECT_DOUBLE_EQ(number(distribution("{key: a, uniform: [2, 6]}"), 0.25), 3);
  const auto normal = distribution("{key: a, normal: [10, 2]}");
  EXPECT_DOUBLE_EQ(number(normal, 0.5), 10);
  EXPECT_NEAR(number(normal, 0.975), 10 + 2 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(number(normal, 1e-12), 10 - 2 * 7.034483825301132, 1e-8);
  const auto lognormal = distribution("{key: a, lognormal: [3, 0.4]}");
  EXPECT_DOUBLE_EQ(number(lognormal, 0.5), 3);
  EXPECT_NEAR(number(lognormal, 0.9),
              boost::math::quantile(boost::math::lognormal(std::log(3), 0.4), 0.9), 1e-12);
}

TEST(Distributions, ATruncatedNormalStaysWithinItsEndsAlsoFarOut) {
  const auto phi = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  const auto near = distribution("{key: a, truncated_normal: [0, 1, -0.5, 2]}");
  std::vector<double> values;
  for (const auto& p : unit_points(Sampling::random, 4000, 1, 1, 0))
    values.push_back(number(near, p[0]));
  EXPECT_GE(*std::min_element(values.begin(), values.end()), -0.5);
  EXPECT_LE(*std::max_element(values.begin(), values.end()), 2);
  EXPECT_LT(
      kolmogorov(values, [&](double x) { return (phi(x) - phi(-0.5)) / (phi(2) - phi(-0.5)); }),
      1.95);  // p = .001
  // Thirty deviations out the density falls as exp(-30 (x - 30)): the median follows.
  for (const char* text : {"{key: a, truncated_normal: [0, 1, 30, 40]}",
                           "{key: a, truncated_normal: [0, 1, -40, -30]}"})
    EXPECT_NEAR(std::abs(number(distribution(text), 0.5)), 30 + std::log(2.0) / 30, 1e-4) << text;
  EXPECT_LT(number(distribution("{key: a, truncated_normal: [0, 1, 30, 40]}"), 0.1),
            number(distribution("{key: a, truncated_normal: [0, 1, 30, 40]}"), 0.9));
}

TEST(Distributions, AChoiceTakesEachValueEquallyOften) {
  const auto choice = distribution("{key: a, choice: [trapezoidal, hermite_simpson, 3]}");
  EXPECT_EQ(choice.distribution.chosen(1e-17).text, "trapezoidal");
  EXPECT_EQ(choice.distribution.chosen(0.34).text, "hermite_simpson");
  EXPECT_EQ(choice.distribution.chosen(1 - 0x1p-53).text, "3");
}

TEST(Distributions, RefuseWhatMakesNone) {
  for (const char* text :
       {"{key: a}", "{key: a, uniform: [1, 2], normal: [0, 1]}", "{key: a, uniform: [2, 1]}",
        "{key: a, uniform: [1]}", "{key: a, normal: [0, 0]}", "{key: a, lognormal: [0, 1]}",
        "{key: a, lognormal: [1, -1]}", "{key: a, truncated_normal: [0, 1, 2, 2]}",
        "{key: a, truncated_normal: [0, 1, 50, 60]}", "{key: a, truncated_normal: [0, 1]}",
        "{key: a, choice: []}", "{key: a, triangular: [1, 2]}", "{key: a, normal: [0, .nan]}"})
    EXPECT_THROW((void)distribution(text), InvalidValue) << text;
}

}  // namespace
}  // namespace slalom::sweep
