#include "slalom/expr/derivative_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "slalom/base/error.hpp"

namespace slalom::expr {
namespace {

/// f0 = u² sin(v), f1 = exp(w) + v, with right derivatives, to be spoilt by each test.
StatedDerivatives right() {
  StatedDerivatives s;
  s.variables = 3;
  s.outputs = 2;
  s.variable_names = {"u", "v", "w"};
  s.values = [](std::span<const double> x, std::span<double> f) {
    f[0] = x[0] * x[0] * std::sin(x[1]);
    f[1] = std::exp(x[2]) + x[1];
  };
  s.jacobian_pattern = {{0, 0}, {0, 1}, {1, 1}, {1, 2}};
  s.jacobian = [](std::span<const double> x, std::span<double> j) {
    j[0] = 2 * x[0] * std::sin(x[1]);
    j[1] = x[0] * x[0] * std::cos(x[1]);
    j[2] = 1;
    j[3] = std::exp(x[2]);
  };
  s.hessian_pattern = {{0, 0}, {1, 0}, {1, 1}, {2, 2}};
  s.hessian = [](std::span<const double> x, std::span<const double> w, std::span<double> h) {
    h[0] = w[0] * 2 * std::sin(x[1]);
    h[1] = w[0] * 2 * x[0] * std::cos(x[1]);
    h[2] = -w[0] * x[0] * x[0] * std::sin(x[1]);
    h[3] = w[1] * std::exp(x[2]);
  };
  return s;
}
const std::vector<std::vector<double>> kPoints = {{1.2, 0.7, -0.4}, {-0.8, 2.1, 1.5}};

/// `right` with one derivative changed after it is computed.
StatedDerivatives spoilt_jacobian(void (*change)(std::span<double>)) {
  auto s = right();
  s.jacobian = [good = s.jacobian, change](std::span<const double> x, std::span<double> j) {
    good(x, j);
    change(j);
  };
  return s;
}
StatedDerivatives spoilt_hessian(void (*change)(std::span<double>)) {
  auto s = right();
  s.hessian = [good = s.hessian, change](std::span<const double> x, std::span<const double> w,
                                         std::span<double> h) {
    good(x, w, h);
    change(h);
  };
  return s;
}

void expect_worst(const WorstEntry& worst, Entry entry) {
  EXPECT_EQ((Entry{worst.row, worst.col}), entry);
}

TEST(DerivativeCheck, RightDerivativesPassWithRoom) {
  const auto report = check_derivatives(right(), kPoints);
  EXPECT_TRUE(report.passed) << to_string(report);
  EXPECT_LT(report.jacobian.error, 1e-9);
  EXPECT_LT(report.hessian.error, 1e-9);
  EXPECT_EQ(report.points, 2u);
}

TEST(DerivativeCheck, AWrongSignIsFoundAndNamed) {
  const auto report = check_derivatives(spoilt_jacobian([](auto j) { j[3] = -j[3]; }), kPoints);
  EXPECT_FALSE(report.passed);
  expect_worst(report.jacobian, {1, 2});
  EXPECT_NEAR(report.jacobian.error, 2, 1e-8);
  EXPECT_NEAR(report.jacobian.measured, -report.jacobian.stated, 1e-8);
  EXPECT_EQ(report.jacobian.col_name, "w");
  EXPECT_EQ(report.jacobian.row_name, "output 1");
  EXPECT_NE(to_string(report).find("output 1 by w"), std::string::npos) << to_string(report);
  EXPECT_NE(to_string(report).find("DISAGREE"), std::string::npos);
}

TEST(DerivativeCheck, ASmallErrorIsFoundOnceAboveTolerance) {
  auto wrong = spoilt_jacobian([](auto j) { j[1] *= 1 + 1e-6; });
  wrong.hessian = nullptr;
  EXPECT_FALSE(check_derivatives(wrong, kPoints).passed);
  EXPECT_NEAR(check_derivatives(wrong, kPoints).jacobian.error, 1e-6, 1e-9);
  EXPECT_TRUE(check_derivatives(wrong, kPoints, {.tolerance = 1e-5}).passed);
  EXPECT_FALSE(check_derivatives(wrong, kPoints).has_hessian);
}

TEST(DerivativeCheck, AnEntryMissingFromThePatternIsFound) {
  auto wrong = right();
  wrong.jacobian_pattern = {{0, 0}, {0, 1}, {1, 2}};
  wrong.jacobian = [good = right().jacobian](std::span<const double> x, std::span<double> j) {
    std::vector<double> all(4);
    good(x, all);
    j[0] = all[0], j[1] = all[1], j[2] = all[3];
  };
  const auto report = check_derivatives(wrong, kPoints);
  EXPECT_FALSE(report.passed);
  expect_worst(report.jacobian, {1, 1});
  EXPECT_FALSE(report.jacobian.in_pattern);
  EXPECT_NE(to_string(report).find("not in the pattern"), std::string::npos);
}

TEST(DerivativeCheck, AWrongPlaceAndATransposeAreFound) {
  auto moved = right();
  moved.jacobian_pattern[3] = {1, 0};
  EXPECT_FALSE(check_derivatives(moved, kPoints).passed);

  StatedDerivatives s;  // f = (x0 x1, x1), its Jacobian stated transposed
  s.variables = s.outputs = 2;
  s.values = [](std::span<const double> x, std::span<double> f) {
    f[0] = x[0] * x[1];
    f[1] = x[1];
  };
  s.jacobian = [](std::span<const double> x, std::span<double> j) {
    j[0] = x[1], j[1] = x[0], j[2] = 1;
  };
  s.jacobian_pattern = {{0, 0}, {0, 1}, {1, 1}};
  EXPECT_TRUE(check_derivatives(s, {{2, 3}}).passed);
  s.jacobian_pattern = {{0, 0}, {1, 0}, {1, 1}};
  const auto report = check_derivatives(s, {{2, 3}});
  EXPECT_FALSE(report.passed);
  EXPECT_EQ(report.jacobian.row + report.jacobian.col, 1u) << "one of the two off the diagonal";
}

TEST(DerivativeCheck, WrongHessiansAreFound) {
  const auto sign = check_derivatives(spoilt_hessian([](auto h) { h[2] = -h[2]; }), kPoints);
  EXPECT_FALSE(sign.passed);
  EXPECT_LT(sign.jacobian.error, 1e-9);
  expect_worst(sign.hessian, {1, 1});
  EXPECT_EQ(sign.hessian.row_name, "v");

  const auto half = check_derivatives(spoilt_hessian([](auto h) { h[1] /= 2; }), kPoints);
  expect_worst(half.hessian, {1, 0});
  EXPECT_NEAR(half.hessian.error, 0.5, 1e-8);

  auto unweighted = right();
  unweighted.hessian = [good = unweighted.hessian](std::span<const double> x,
                                                   std::span<const double>, std::span<double> h) {
    good(x, std::vector<double>{1, 1}, h);
  };
  EXPECT_FALSE(check_derivatives(unweighted, kPoints).passed) << "default weights are not all 1";
  EXPECT_TRUE(check_derivatives(unweighted, kPoints, {.weights = {1, 1}}).passed);

  auto missing = right();
  missing.hessian_pattern.pop_back();
  missing.hessian = [good = right().hessian](std::span<const double> x, std::span<const double> w,
                                             std::span<double> h) {
    std::vector<double> all(4);
    good(x, w, all);
    std::copy_n(all.begin(), 3, h.begin());
  };
  expect_worst(check_derivatives(missing, kPoints).hessian, {2, 2});
}

TEST(DerivativeCheck, AJacobianWrongShowsInTheHessianToo) {
  const auto report = check_derivatives(spoilt_jacobian([](auto j) { j[0] *= 3; }), kPoints);
  EXPECT_GT(report.jacobian.error, 0.1);
  EXPECT_GT(report.hessian.error, 0.1);
}

TEST(DerivativeCheck, NotFiniteFails) {
  const auto nan = check_derivatives(spoilt_jacobian([](auto j) { j[2] = std::nan(""); }), kPoints);
  EXPECT_FALSE(nan.passed);
  EXPECT_TRUE(std::isinf(nan.jacobian.error));
  expect_worst(nan.jacobian, {1, 1});

  const Expr x = Expr::symbol("x");
  EXPECT_FALSE(check_derivatives(Function({x}, {}, {sqrt(x)}), {{0.0}}).passed)
      << "the edge of the domain";
}

TEST(DerivativeCheck, NearTheEdgeOfTheDomainStepsShrink) {
  const Expr x = Expr::symbol("x");
  const auto report =
      check_derivatives(Function({x}, {}, {log(x), sqrt(x), asin(x)}), {{1e-3}, {0.9}});
  EXPECT_TRUE(report.passed) << to_string(report);
}

TEST(DerivativeCheck, AtAKinkTheDifferenceIsTheMeanOfBothSides) {
  const Expr x = Expr::symbol("x");
  const Function f({x}, {}, {max(x, 0)});
  const auto at = check_derivatives(f, {{0.0}});
  EXPECT_FALSE(at.passed);
  EXPECT_NEAR(at.jacobian.measured, 0.5, 1e-9);
  EXPECT_TRUE(check_derivatives(f, {{0.01}, {-0.01}}).passed);
}

TEST(DerivativeCheck, LargeAndSmallNumbersAreJudgedByTheirScale) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  const Function f({x, y}, {}, {1e9 * sin(x) + 1e-9 * y, 1e-12 * exp(y)});
  EXPECT_TRUE(check_derivatives(f, {{0.3, 0.2}, {1.1, -2}}).passed);
  const Function far({x}, {}, {sin(x / 1e5) * 3});
  EXPECT_TRUE(check_derivatives(far, {{1.3e5}}).passed);
}

TEST(DerivativeCheck, FunctionsTakeDataAndNames) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y"), p = Expr::symbol("p");
  const Function f({x, y}, {p}, {p * sin(x * y), x / (p + y * y)});
  const std::vector<double> data = {3};
  const auto report = check_derivatives(
      f, {{0.4, 1.2}}, data, {.variable_names = {"x", "y"}, .output_names = {"first", "second"}});
  EXPECT_TRUE(report.passed) << to_string(report);
  EXPECT_TRUE(report.has_hessian);
  EXPECT_TRUE(report.hessian.col_name == "x" || report.hessian.col_name == "y");
  EXPECT_NE(to_string(report).find("agree"), std::string::npos);
  EXPECT_THROW(check_derivatives(f, {{0.4, 1.2}}), Error) << "no data";
}

TEST(DerivativeCheck, RefusesWhatCannotBeCompared) {
  const auto throws = [](auto change) {
    auto s = right();
    change(s);
    EXPECT_THROW(check_derivatives(s, kPoints), Error);
  };
  throws([](auto& s) { s.jacobian_pattern[0].row = 2; });
  throws([](auto& s) { s.jacobian_pattern[0].col = 3; });
  throws([](auto& s) { s.jacobian_pattern[0] = s.jacobian_pattern[1]; });
  throws([](auto& s) { s.hessian_pattern[1] = {0, 1}; });
  throws([](auto& s) { s.variable_names.pop_back(); });
  throws([](auto& s) { s.output_names = {"one"}; });
  throws([](auto& s) { s.values = nullptr; });
  throws([](auto& s) { s.jacobian = nullptr; });
  EXPECT_THROW(check_derivatives(right(), {}), Error);
  EXPECT_THROW(check_derivatives(right(), {{1, 2}}), Error);
  EXPECT_THROW(check_derivatives(right(), kPoints, {.weights = {1}}), Error);
}

}  // namespace
}  // namespace slalom::expr
