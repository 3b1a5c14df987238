#include <gtest/gtest.h>

#include <barrier>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include "slalom/expr/function.hpp"

namespace slalom::expr {
namespace {

/// Of symbols made anew each time, as a problem that is stated again has them.
Function wave(double factor, std::size_t data = 1) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  std::vector<Expr> given;
  while (given.size() < data) given.push_back(Expr::symbol("p"));
  return Function({x, y}, given, {sin(factor * x) * y + given[0], x / (1 + y * y)});
}

/// Whether two functions share what was derived.
bool share(const Function& a, const Function& b) {
  return &a.jacobian_pattern() == &b.jacobian_pattern();
}

Function stepped(std::vector<double> values) {
  const Expr x = Expr::symbol("x");
  return Function(
      {x}, {},
      {x * Expr::apply(std::make_shared<const Steps>(Steps{{0, 1}, std::move(values)}), x)});
}

/// Of so many vertices and more.
Function chain(std::size_t length, double first) {
  const Expr x = Expr::symbol("x");
  Expr e = x + first;
  for (std::size_t i = 0; i < length; ++i) e = sin(e);
  return Function({x}, {}, {e});
}

TEST(KeptFunctions, OneStatedAgainIsTheSame) {
  EXPECT_TRUE(share(wave(2), wave(2)));
  const auto* pattern = &wave(3).jacobian_pattern();  // nobody holds the function any more
  EXPECT_EQ(&wave(3).jacobian_pattern(), pattern);
  EXPECT_TRUE(share(stepped({1, 2}), stepped({1, 2})));
}

TEST(KeptFunctions, OneThatDiffersInTheLastBitIsAnother) {
  const Function f = wave(2);
  EXPECT_FALSE(share(f, wave(std::nextafter(2, 3))));
  EXPECT_FALSE(share(f, wave(2, 2))) << "more data";
  EXPECT_FALSE(share(stepped({1, 2}), stepped({1, std::nextafter(2, 3)})));
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  EXPECT_FALSE(share(Function({x, y}, {}, {x * y}), Function({x}, {y}, {x * y}))) << "as data";
  EXPECT_FALSE(share(Function({x, y}, {}, {x, y}), Function({x, y}, {}, {x, x}))) << "outputs";
}

TEST(KeptFunctions, LargeOnesAreNotKeptAndManyPushOutTheOldest) {
  EXPECT_FALSE(share(chain(3000, 0), chain(3000, 0)));
  const Function old = chain(1500, 0), used = chain(1500, 1);
  for (int i = 2; i < 30; ++i) {
    chain(1500, i);
    EXPECT_TRUE(share(used, chain(1500, 1))) << "used after " << i;
  }
  EXPECT_FALSE(share(old, chain(1500, 0)));
}

TEST(KeptFunctions, ThreadsThatStateOneShareIt) {
  const std::vector<double> x = {0.4, 0.9}, p = {0.3}, weights = {1, 2};
  constexpr Wanted kHessian{.values = false, .jacobian = false, .hessian = true};
  std::vector<double> want(wave(7).hessian_pattern().size());
  wave(7).evaluate(1, x, p, weights, kHessian, {}, {}, want);
  for (std::size_t data = 2; data < 20; ++data) {  // unused, so that each time one is derived
    std::vector<double> numbers(data, p[0]);
    std::barrier start(6);
    std::vector<Function> made(6);
    std::vector<std::vector<double>> got(6, std::vector<double>(want.size()));
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < made.size(); ++t)
      threads.emplace_back([&, t] {
        start.arrive_and_wait();
        made[t] = wave(7, data);
        made[t].evaluate(1, x, numbers, weights, kHessian, {}, {}, got[t]);
      });
    for (auto& thread : threads) thread.join();
    for (std::size_t t = 0; t < made.size(); ++t) {
      EXPECT_EQ(got[t], want);
      EXPECT_TRUE(share(made[0], made[t]));
    }
  }
}

}  // namespace
}  // namespace slalom::expr
