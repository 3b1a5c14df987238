#include "slalom/ocp/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "ocp/messages.hpp"

namespace slalom::ocp {
namespace {

constexpr double kRound = 1e-14;

void expect_rule(const Quadrature& rule, const std::vector<double>& points,
                 const std::vector<double>& weights) {
  ASSERT_EQ(rule.points.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(rule.points[i], points[i], kRound) << i;
    EXPECT_NEAR(rule.weights[i], weights[i], kRound) << i;
  }
}

// Abramowitz & Stegun 1964, tables 25.4, 25.6 and section 25.4.31; closed forms where there are.
TEST(Quadrature, MatchesPublishedTables) {
  const double a = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3,
               b = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double wa = (322 + 13 * std::sqrt(70)) / 900, wb = (322 - 13 * std::sqrt(70)) / 900;
  expect_rule(legendre_gauss(1), {0}, {2});
  expect_rule(legendre_gauss(5), {-b, -a, 0, a, b}, {wb, wa, 128.0 / 225, wa, wb});
  expect_rule(legendre_gauss_radau(1), {-1}, {2});
  expect_rule(legendre_gauss_radau(2), {-1, 1.0 / 3}, {0.5, 1.5});
  expect_rule(legendre_gauss_radau(3), {-1, (1 - std::sqrt(6)) / 5, (1 + std::sqrt(6)) / 5},
              {2.0 / 9, (16 + std::sqrt(6)) / 18, (16 - std::sqrt(6)) / 18});
  const double c = std::sqrt(3.0 / 7);
  expect_rule(legendre_gauss_lobatto(2), {-1, 1}, {1, 1});
  expect_rule(legendre_gauss_lobatto(5), {-1, -c, 0, c, 1},
              {0.1, 49.0 / 90, 32.0 / 45, 49.0 / 90, 0.1});
  const double d = std::sqrt((7 - 2 * std::sqrt(7)) / 21),
               e = std::sqrt((7 + 2 * std::sqrt(7)) / 21);
  const double wd = (14 + std::sqrt(7)) / 30, we = (14 - std::sqrt(7)) / 30;
  expect_rule(legendre_gauss_lobatto(6), {-1, -e, -d, d, e, 1},
              {1.0 / 15, we, wd, wd, we, 1.0 / 15});
}

/// Largest error of the rule for Legendre polynomials up to `degree`.
double error_to(const Quadrature& rule, int degree) {
  double worst = 0;
  for (int k = 0; k <= degree; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < rule.points.size(); ++i)
      sum += rule.weights[i] * std::legendre(static_cast<unsigned>(k), rule.points[i]);
    worst = std::max(worst, std::fabs(sum - (k == 0 ? 2 : 0)));
  }
  return worst;
}

TEST(Quadrature, IsExactToItsDegreeAndNoFurther) {
  for (int n : {2, 3, 7, 16, 30, 60}) {
    EXPECT_LT(error_to(legendre_gauss(n), 2 * n - 1), 2e-14) << n;
    EXPECT_LT(error_to(legendre_gauss_radau(n), 2 * n - 2), 2e-14) << n;
    EXPECT_LT(error_to(legendre_gauss_lobatto(n), 2 * n - 3), 2e-14) << n;
    EXPECT_GT(error_to(legendre_gauss(n), 2 * n), 1e-3) << n;
    EXPECT_GT(error_to(legendre_gauss_radau(n), 2 * n - 1), 1e-3) << n;
    EXPECT_GT(error_to(legendre_gauss_lobatto(n), 2 * n - 2), 1e-3) << n;
  }
}

TEST(Quadrature, PointsRiseInsideTheInterval) {
  for (int n : {2, 5, 30, 100})
    for (const auto& rule :
         {legendre_gauss(n), legendre_gauss_radau(n), legendre_gauss_lobatto(n)}) {
      EXPECT_GE(rule.points.front(), -1);
      EXPECT_LE(rule.points.back(), 1);
      for (std::size_t i = 1; i < rule.points.size(); ++i)
        EXPECT_GT(rule.points[i], rule.points[i - 1]);
      for (double w : rule.weights) EXPECT_GT(w, 0);
    }
}

TEST(Interpolation, DifferentiatesAndIntegratesPolynomials) {
  const auto points = legendre_gauss_radau(12).points;
  const Interpolation through(points);
  const auto d = through.differentiation();
  for (unsigned degree = 0; degree < 12; ++degree) {
    const auto value = [&](double x) { return std::pow(0.5 + x, degree); };
    const double at = 0.3;
    double sum = 0;
    const auto basis = through.basis(at), integral = through.integrals(-1, at);
    double area = 0;
    for (std::size_t j = 0; j < points.size(); ++j) {
      sum += basis[j] * value(points[j]);
      area += integral[j] * value(points[j]);
    }
    EXPECT_NEAR(sum, value(at), 1e-12);
    EXPECT_NEAR(area, (std::pow(0.5 + at, degree + 1) - std::pow(-0.5, degree + 1)) / (degree + 1),
                1e-12);
    for (std::size_t i = 0; i < points.size(); ++i) {
      double slope = 0;
      for (std::size_t j = 0; j < points.size(); ++j) slope += d[i][j] * value(points[j]);
      const double exact = degree == 0 ? 0 : degree * std::pow(0.5 + points[i], degree - 1.0);
      EXPECT_NEAR(slope, exact, 1e-9) << degree;
    }
  }
  EXPECT_EQ(through.basis(points[3])[3], 1);
}

TEST(Quadrature, ErrorsSayWhatAndTheRule) {
  using test::refusal;
  EXPECT_EQ(refusal([] { legendre_gauss(0); }),
            "Legendre-Gauss rule: found 0 points, expected at least 1");
  EXPECT_EQ(refusal([] { legendre_gauss_lobatto(1); }),
            "Legendre-Gauss-Lobatto rule: found 1 points, expected at least 2");
  EXPECT_EQ(refusal([] {
              Interpolation({0, 1, 0});
            }),
            "interpolation: found point 0 twice, expected distinct points");
}

}  // namespace
}  // namespace slalom::ocp
