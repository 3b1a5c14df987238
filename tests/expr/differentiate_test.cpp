#include <gtest/gtest.h>

#include <limits>

#include "expr/op_cases.hpp"
#include "expr/reference.hpp"
#include "slalom/expr/function.hpp"
#include "support/sanitized.hpp"

namespace slalom::expr {
namespace {

constexpr int points = kSanitized ? 20 : 100;
constexpr double kInf = std::numeric_limits<double>::infinity();
using reference::full_hessian;
using reference::full_jacobian;

/// [value, first derivatives..., second derivatives of the lower triangle...] at x.
struct Derivatives {
  std::vector<double> first, second;  ///< full matrices
};
Derivatives derivatives(const Expr& e, const std::vector<Expr>& symbols,
                        const std::vector<double>& x) {
  const Function f(symbols, {}, {e});
  return {full_jacobian(f, x), full_hessian(f, x, {1})};
}

TEST(Differentiate, EveryOperationAlone) {
  std::mt19937_64 random(4);
  for (const auto& c : op_cases()) {
    const auto symbols = c.symbols();
    for (int i = 0; i < points; ++i) {
      double first = 0;
      const double both =
          reference::derivative_error({c.build(symbols)}, symbols, c.point(random), {1.3}, &first);
      ASSERT_LE(first, 1e-11) << c.name;
      ASSERT_LE(both, 1e-7) << c.name;
    }
  }
}

/// Outer and inner functions that are not linear exercise first times second derivatives.
TEST(Differentiate, EveryOperationInsideOthers) {
  std::mt19937_64 random(5);
  for (const auto& c : op_cases()) {
    const auto symbols = c.symbols();
    auto inner = symbols;
    for (std::size_t i = 0; i < inner.size(); ++i) {  // stays in the range it was given
      const auto [lo, hi] = c.range[i];
      inner[i] = (lo + hi) / 2 + (hi - lo) / 2 * sin(symbols[i] * symbols[symbols.size() - 1 - i]);
    }
    const Expr v = c.build(inner);
    for (int i = 0; i < points; ++i) {
      double first = 0;
      const double both = reference::derivative_error({sin(0.1 * v) + v * inner[0]}, symbols,
                                                      c.point(random), {0.7}, &first);
      ASSERT_LE(first, 1e-9) << c.name;
      ASSERT_LE(both, 1e-7) << c.name;
    }
  }
}

TEST(Differentiate, RepeatedArguments) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y"), s = sin(x) + 2;
  const std::vector<Expr> outputs = {
      atan2(x, x),     pow(x, x),     x * x * x,   x / x,     x - x,           x + x,
      min(x, x),       max(x, x),     atan2(s, s), pow(s, s), s * s * s,       s / s,
      s - s,           s + s,         min(s, s),   max(s, s), select(x, x, x), select(s, s, s * y),
      select(y, s, x), pow(s, s * y), x * (y * x)};
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> coordinate(0.3, 3);
  for (int i = 0; i < points; ++i)
    for (const auto& output : outputs) {
      double first = 0;
      const double both = reference::derivative_error(
          {output}, {x, y}, {coordinate(random), coordinate(random)}, {1}, &first);
      ASSERT_LE(first, 1e-11);
      ASSERT_LE(both, 1e-7);
    }
}

TEST(Differentiate, PowersOfAConstantExponent) {
  const Expr x = Expr::symbol("x");
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(0.4, 2);
  for (double n :
       {0.0, 1.0, 2.0, 3.0, 7.0, 8.0, 13.0, -1.0, -2.0, -5.0, 0.5, -0.5, 1.5, 2.7, 65.0, -70.0})
    for (int i = 0; i < 40; ++i) {
      const bool integer = n == std::floor(n);
      const double at = (integer && i % 2 != 0 ? -1 : 1) * coordinate(random);
      double first = 0;
      const double both = reference::derivative_error({pow(x, n)}, {x}, {at}, {1}, &first);
      ASSERT_LE(first, 1e-11) << "x^" << n << " at " << at;
      ASSERT_LE(both, 1e-7) << "x^" << n << " at " << at;
    }
}

TEST(Differentiate, KinksAreAsDocumented) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  const auto first = [&](const Expr& e) { return derivatives(e, {x, y}, {0, 0}).first; };
  EXPECT_EQ(first(abs(x)), (std::vector<double>{0, 0}));
  EXPECT_EQ(first(sign(x)), (std::vector<double>{0, 0}));
  EXPECT_EQ(first(min(x, y)), (std::vector<double>{0, 1})) << "b's at a = b";
  EXPECT_EQ(first(max(x, y)), (std::vector<double>{0, 1})) << "b's at a = b";
  EXPECT_EQ(first(max(0, x)), (std::vector<double>{1, 0}));
  EXPECT_EQ(first(max(x, 0)), (std::vector<double>{0, 0}));
  EXPECT_EQ(first(select(x, 2 * y, 3 * y)), (std::vector<double>{0, 3})) << "0 is not positive";
  EXPECT_EQ(first(sqrt(x))[0], kInf);
  EXPECT_EQ(derivatives(sqrt(x), {x}, {0}).second[0], -kInf);
  EXPECT_EQ(derivatives(pow(x, 3), {x}, {0}).second[0], 0);
  EXPECT_EQ(derivatives(pow(x, 2), {x}, {0}).second[0], 2);
  EXPECT_EQ(derivatives(pow(x, 1.5), {x}, {0}).first[0], 0);
}

/// Outside its domain a branch that is not taken must not spoil the one that is: 0 * NaN is NaN.
TEST(Differentiate, ABranchNotTakenHasDerivativeZero) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  const Expr root = sqrt(x) * y + log(x);
  const struct {
    Expr guarded, plain;
  } cases[] = {
      {select(x, root, y * y), y * y},
      {select(x, sin(root) * y, y * x * x), y * x * x},
      {exp(select(x, root * root, y)) * y, exp(y) * y},
      {3 * select(x, root / y, y) - x, 3 * y - x},
      {select(-x, y * x, pow(x, y)) + y * y, y * x + y * y},
      {square(select(x, root, x * y)), square(x * y)},
      {-select(x, 1 / root, x * y) / y, -(x * y) / y},
      {select(x, root, 0) * select(x, y, 1) + x * y, x * y},
      {select(x, root, y) * select(x - 1, sqrt(x), y), y * y},
      {select(sin(select(x, root, y) - 9), root, y) * select(x, root, x), x * y},
  };
  for (const auto& [guarded, plain] : cases)
    for (double at : {-2.0, 0.0}) {
      if (at == 0 && &guarded == &cases[4].guarded) continue;  // 0 takes the other branch there
      const auto got = derivatives(guarded, {x, y}, {at, 1.5});
      const auto want = derivatives(plain, {x, y}, {at, 1.5});
      for (int k = 0; k < 2; ++k) EXPECT_DOUBLE_EQ(got.first[k], want.first[k]) << at;
      for (int k = 0; k < 4; ++k) EXPECT_NEAR(got.second[k], want.second[k], 1e-14) << at;
    }
}

std::vector<Entry> entries(std::initializer_list<Entry> list) {
  return list;
}

TEST(Sparsity, JacobianHoldsWhatDependsAndNoMore) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y"), z = Expr::symbol("z"),
             p = Expr::symbol("p");
  const Function f({x, y, z}, {p},
                   {z * x, p, Expr(3), sin(y) + x - x, y, select(z, x, y), sign(x) * y,
                    (x + y) - (x - y), x * y - y * x});
  EXPECT_EQ(f.jacobian_pattern(),
            entries({{0, 0}, {0, 2}, {3, 1}, {4, 1}, {5, 0}, {5, 1}, {6, 1}, {7, 1}}));
}

TEST(Sparsity, HessianOfASeparableFunctionIsDiagonal) {
  std::vector<Expr> x;
  Expr sum, linear, product = 1;
  for (int i = 0; i < 30; ++i) {
    x.push_back(Expr::symbol("x" + std::to_string(i)));
    sum += sin(x.back()) * exp(x.back()) / (2 + i);
    linear += i * x.back() / 3 - 2;
  }
  const Function f(x, {}, {sum, linear, x[0] * 4});
  ASSERT_EQ(f.hessian_pattern().size(), 30u);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(f.hessian_pattern()[i], (Entry{i, i}));
  EXPECT_EQ(f.jacobian_pattern().size(), 30u + 29u + 1u);
}

TEST(Sparsity, HessianHoldsTheInteractionsThatExist) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y"), z = Expr::symbol("z"),
             p = Expr::symbol("p");
  EXPECT_EQ(Function({x, y, z}, {p}, {x * y + p * z, z * z}).hessian_pattern(),
            entries({{1, 0}, {2, 2}}));
  EXPECT_EQ(Function({x, y, z}, {p}, {atan2(x, z), y / p}).hessian_pattern(),
            entries({{0, 0}, {2, 0}, {2, 2}}));
  EXPECT_EQ(Function({x, y, z}, {}, {max(x * x, y * z)}).hessian_pattern(),
            entries({{0, 0}, {2, 1}}))
      << "the two sides of a maximum do not interact";
  EXPECT_EQ(Function({x, y}, {p}, {abs(x) * sign(y) + select(x, y, p)}).hessian_pattern(),
            entries({}));
  EXPECT_EQ(Function({x, y}, {}, {x / y}).hessian_pattern(), entries({{1, 0}, {1, 1}}));
  EXPECT_EQ(Function({x, y}, {}, {square(x + y) - square(x - y) - 4 * x * y}).hessian_pattern(),
            entries({{0, 0}, {1, 0}, {1, 1}}))
      << "algebra beyond single operations is not attempted";
}

}  // namespace
}  // namespace slalom::expr
