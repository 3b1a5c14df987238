#include "slalom/expr/expr.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "expr/op_cases.hpp"
#include "expr/reference.hpp"
#include "slalom/base/error.hpp"
#include "support/sanitized.hpp"

namespace slalom::expr {
namespace {

template <class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Expr, DefaultIsTheConstantZero) {
  EXPECT_TRUE(Expr().is_constant(0));
  EXPECT_FALSE(Expr(1.0).is_constant(0));
  EXPECT_FALSE(Expr::symbol("x").is_constant());
}

TEST(Expr, ConstantsFoldToTheReferenceValue) {
  std::mt19937_64 random(1);
  for (const auto& c : op_cases())
    for (int i = 0; i < 20; ++i) {
      const auto x = c.point(random);
      const Expr folded = c.build({x.begin(), x.end()});
      ASSERT_TRUE(folded.is_constant()) << c.name;
      const auto symbols = c.symbols();
      const double expected = reference::values({c.build(symbols)}, symbols, x)[0];
      EXPECT_NEAR(folded.value(), expected, 1e-14 * std::max(1.0, std::fabs(expected))) << c.name;
    }
}

TEST(Expr, FunctionsAndOperatorsBuildTheirOperation) {
  const Expr a = Expr::symbol("a"), b = Expr::symbol("b"), c = Expr::symbol("c");
  const auto steps = std::make_shared<Steps>(Steps{{0, 1}, {2, 3}});
  const std::vector<std::pair<Expr, Op>> built = {{-a, Op::neg},
                                                  {square(a), Op::square},
                                                  {sqrt(a), Op::sqrt},
                                                  {exp(a), Op::exp},
                                                  {log(a), Op::log},
                                                  {sin(a), Op::sin},
                                                  {cos(a), Op::cos},
                                                  {tan(a), Op::tan},
                                                  {asin(a), Op::asin},
                                                  {acos(a), Op::acos},
                                                  {atan(a), Op::atan},
                                                  {sinh(a), Op::sinh},
                                                  {cosh(a), Op::cosh},
                                                  {tanh(a), Op::tanh},
                                                  {abs(a), Op::abs},
                                                  {sign(a), Op::sign},
                                                  {Expr::apply(steps, a), Op::lookup},
                                                  {a + b, Op::add},
                                                  {a - b, Op::sub},
                                                  {a * b, Op::mul},
                                                  {a / b, Op::div},
                                                  {pow(a, b), Op::pow},
                                                  {atan2(a, b), Op::atan2},
                                                  {min(a, b), Op::min},
                                                  {max(a, b), Op::max},
                                                  {select(a, b, c), Op::select}};
  EXPECT_EQ(built.size(), static_cast<std::size_t>(Op::select) - 1) << "one for each operation";
  for (const auto& [e, op] : built) {
    EXPECT_EQ(e.node()->op(), op);
    EXPECT_TRUE(e.node()->args()[0].same(a));
    if (e.node()->args().size() > 1) {
      EXPECT_TRUE(e.node()->args()[1].same(b));
    }
    if (e.node()->args().size() > 2) {
      EXPECT_TRUE(e.node()->args()[2].same(c));
    }
  }
  EXPECT_TRUE((+a).same(a));
}

TEST(Expr, CompoundAssignment) {
  const Expr a = Expr::symbol("a"), b = Expr::symbol("b");
  Expr e = a;
  e += b;
  e *= 3;
  e -= a;
  e /= b;
  EXPECT_DOUBLE_EQ(reference::values<double>({e}, {a, b}, {2, 5})[0], ((2.0 + 5) * 3 - 2) / 5);
  EXPECT_TRUE(a.is_symbol()) << "the operand is not changed";
}

TEST(Expr, SymbolsAreDistinctEvenOfOneName) {
  const Expr a = Expr::symbol("a"), copy = a, other = Expr::symbol("a");
  EXPECT_TRUE(a.same(copy));
  EXPECT_FALSE(a.same(other));
  EXPECT_EQ(other.name(), "a");
}

TEST(Expr, ValueAndNameAreOfTheirKindOnly) {
  const Expr a = Expr::symbol("a");
  EXPECT_THROW((void)a.value(), Error);
  EXPECT_THROW((void)(a + 1).value(), Error);
  EXPECT_THROW((void)Expr(1).name(), Error);
  EXPECT_THROW((void)(a + 1).name(), Error);
}

TEST(Substitute, ReplacesThroughoutAndAtOnce) {
  const Expr a = Expr::symbol("a"), b = Expr::symbol("b"), c = Expr::symbol("c");
  const auto swapped = substitute({a - 2 * b, select(a, b, c), a, c}, {a, b}, {b, a});
  EXPECT_EQ(reference::values<double>(swapped, {a, b, c}, {3, 5, 7}),
            (std::vector<double>{5 - 2 * 3, 3, 5, 7}));
  EXPECT_TRUE(swapped[3].same(c)) << "what is not replaced stays the same symbol";
  EXPECT_TRUE(substitute({a * b + 1}, {a, b}, {2, 3})[0].is_constant(7));
}

TEST(Substitute, RefusesWhatIsNotASymbolWrongLengthsAndDoubles) {
  const Expr a = Expr::symbol("a"), b = Expr::symbol("b");
  EXPECT_THROW(substitute({a}, {a + b}, {1}), Error);
  EXPECT_THROW(substitute({a}, {a, b}, {1}), Error);
  EXPECT_EQ(message_of([&] {
              substitute({a}, {a, b, a}, {1, 2, 3});
            }),
            "substitute: 'a' is listed twice");
}

TEST(SymbolsOf, InOrderOfFirstAppearanceEachOnce) {
  const Expr a = Expr::symbol("a"), b = Expr::symbol("b"), c = Expr::symbol("c");
  const auto found = symbols_of({sin(b) + a * b, Expr(3), c, a});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0].same(b));
  EXPECT_TRUE(found[1].same(a));
  EXPECT_TRUE(found[2].same(c));
  EXPECT_TRUE(symbols_of({Expr(1)}).empty());
  EXPECT_TRUE(symbols_of({}).empty());
}

TEST(Expr, AMillionTermsAreReleasedWithoutRecursion) {
  const Expr a = Expr::symbol("a");
  Expr sum = a, chain = a;
  for (int i = 0; i < (kSanitized ? 200'000 : 1'000'000); ++i) {
    sum += a;
    chain = sin(chain);
  }
  EXPECT_EQ(symbols_of({sum, chain}).size(), 1u);
  EXPECT_FALSE(substitute({sum}, {a}, {2 * a})[0].same(sum));
  sum = chain = Expr();
}

TEST(Expr, GraphsSharedByThreadsAreReleasedOnce) {
  for (int round = 0; round < 50; ++round) {
    Expr shared = Expr::symbol("a");
    for (int i = 0; i < 2000; ++i) shared = sin(shared) + i;
    std::vector<std::thread> threads;
    for (int t = 0; t < 8; ++t)
      threads.emplace_back([mine = shared]() mutable {
        for (int i = 0; i < 100; ++i) mine = mine + i;
        mine = Expr();
      });
    shared = Expr();
    for (auto& thread : threads) thread.join();
  }
}

}  // namespace
}  // namespace slalom::expr
