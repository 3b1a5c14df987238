#include "slalom/expr/function.hpp"

#include <gtest/gtest.h>

#include <barrier>
#include <cstring>
#include <thread>

#include "expr/reference.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"
#include "support/sanitized.hpp"

namespace slalom::expr {
namespace {

std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

/// All results of one evaluation.
struct Results {
  std::vector<double> values, jacobian, hessian;

  Results(const Function& f, std::size_t lanes, const std::vector<double>& x,
          const std::vector<double>& p, const std::vector<double>& weights, Wanted wanted) {
    if (wanted.values) values.resize(f.outputs() * lanes);
    if (wanted.jacobian) jacobian.resize(f.jacobian_pattern().size() * lanes);
    if (wanted.hessian) hessian.resize(f.hessian_pattern().size() * lanes);
    f.evaluate(lanes, x, p, wanted.hessian ? weights : std::vector<double>{}, wanted, values,
               jacobian, hessian);
  }
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

struct Sample {
  Expr x = Expr::symbol("x"), y = Expr::symbol("y"), z = Expr::symbol("z"), p = Expr::symbol("p");
  Function make() const {
    return Function({x, y, z}, {p},
                    {sin(x * y) / (2 + z * z), pow(abs(x) + 1, p) + tanh(z), atan2(y, x) * p,
                     max(x, y) * exp(-z)});
  }
};
constexpr Wanted kAll{.values = true, .jacobian = true, .hessian = true};

TEST(Function, WithoutOutputsHasNoDerivativesAndTakesNoInstructions) {
  const Function f;
  EXPECT_EQ(f.variables() + f.data() + f.outputs(), 0u);
  EXPECT_TRUE(f.jacobian_pattern().empty());
  EXPECT_TRUE(f.hessian_pattern().empty());
  EXPECT_NO_THROW(f.evaluate(3, {}, {}, {}, kAll, {}, {}, {}));
  EXPECT_EQ(f.instructions(kAll), 0u);
}

TEST(Function, ASymbolNobodyGivesOrTwoGiveIsNamed) {
  const Expr x = Expr::symbol("x"), lost = Expr::symbol("lost");
  const auto make = [](std::vector<Expr> v, std::vector<Expr> d, std::vector<Expr> o) {
    return [=] { Function(v, d, o); };
  };
  EXPECT_NE(message_of(make({x}, {}, {x + lost})).find("'lost'"), std::string::npos);
  EXPECT_EQ(message_of(make({x, lost, x}, {}, {x})),
            "function: 'x' is listed twice among the inputs");
  EXPECT_EQ(message_of(make({x}, {lost, x}, {x})),
            "function: 'x' is listed twice among the inputs");
  EXPECT_EQ(message_of(make({x + 1}, {}, {x})), "function: an input is not a symbol");
}

TEST(Function, WrongSizesThrowAndNameTheArray) {
  const Function f = Sample().make();
  const std::size_t n = 5, j = f.jacobian_pattern().size(), h = f.hessian_pattern().size();
  const std::size_t right[] = {3 * n, n, 4 * n, 4 * n, j * n, h * n};
  const char* name[] = {"variables", "data", "weights", "values", "Jacobian", "Hessian"};
  for (int wrong = -1; wrong < 6; ++wrong)
    for (std::size_t change : {std::size_t{1}, ~std::size_t{0}}) {
      std::vector<double> a[6];
      for (int k = 0; k < 6; ++k) a[k].resize(right[k] + (k == wrong ? change : 0), 0.5);
      const auto message =
          message_of([&] { f.evaluate(n, a[0], a[1], a[2], kAll, a[3], a[4], a[5]); });
      if (wrong < 0) {
        EXPECT_EQ(message, "nothing thrown");
      }
      if (wrong >= 0) {
        EXPECT_NE(message.find(name[wrong]), std::string::npos) << message;
      }
    }
}

TEST(Function, WhatIsNotWantedIsNotTouched) {
  const Function f = Sample().make();
  std::vector<double> values(4, 7), jacobian(f.jacobian_pattern().size(), 7);
  const std::vector<double> x = {1, 2, 3}, p = {0.5};
  f.evaluate(1, x, p, {}, {.values = false}, values, jacobian, {});
  f.evaluate(0, {}, {}, {}, kAll, {}, {}, {});
  f.evaluate(1, x, p, {}, {.values = true}, values, jacobian, {});
  EXPECT_NE(values[0], 7);
  EXPECT_EQ(jacobian[0], 7);
}

TEST(Function, EveryLaneHasTheBitsOfASingleLane) {
  const Function f = Sample().make();
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  for (std::size_t lanes = 1; lanes <= 200; ++lanes) {
    std::vector<double> in[3] = {std::vector<double>(3 * lanes), std::vector<double>(lanes),
                                 std::vector<double>(4 * lanes)};
    for (auto& array : in)
      for (auto& v : array) v = coordinate(random);
    const Results batch(f, lanes, in[0], in[1], in[2], kAll);
    for (std::size_t l = 0; l < lanes; ++l) {
      std::vector<double> one[3];
      for (int k = 0; k < 3; ++k)
        for (std::size_t i = l; i < in[k].size(); i += lanes) one[k].push_back(in[k][i]);
      const Results single(f, 1, one[0], one[1], one[2], kAll);
      const auto lane = [&](const std::vector<double>& from) {
        std::vector<double> picked;
        for (std::size_t i = l; i < from.size(); i += lanes) picked.push_back(from[i]);
        return picked;
      };
      ASSERT_TRUE(same_bits(lane(batch.values), single.values)) << lanes << " lanes, lane " << l;
      ASSERT_TRUE(same_bits(lane(batch.jacobian), single.jacobian)) << lanes;
      ASSERT_TRUE(same_bits(lane(batch.hessian), single.hessian)) << lanes;
    }
  }
}

TEST(Function, BitsDoNotDependOnWhatElseIsWantedNorOnTheOrderOfAsking) {
  const std::vector<double> x = {1.1, -0.4, 0.3}, p = {0.7}, w = {1, 2, 3, 4};
  const Sample sample;
  const Function reference_function = sample.make();
  const Results all(reference_function, 1, x, p, w, kAll);
  for (unsigned first = 1; first < 8; ++first)
    for (unsigned second = 1; second < 8; ++second) {
      const Function f = sample.make();
      for (unsigned mask : {first, second}) {
        const Wanted wanted{(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0};
        const Results got(f, 1, x, p, w, wanted);
        if (wanted.values) {
          ASSERT_TRUE(same_bits(got.values, all.values));
        }
        if (wanted.jacobian) {
          ASSERT_TRUE(same_bits(got.jacobian, all.jacobian));
        }
        if (wanted.hessian) {
          ASSERT_TRUE(same_bits(got.hessian, all.hessian));
        }
      }
    }
}

TEST(Function, ThreadsShareOneFromCold) {
  const Sample sample;
  std::vector<Expr> data = {sample.p};
  std::vector<double> p = {0.7};
  const auto make = [&] {  // large enough that the threads' first evaluations overlap
    Expr e = sample.x;
    for (int i = 0; i < 60; ++i) e = sin(e * sample.y) + sample.z * sample.p / (i + 2 + e * e);
    return Function({sample.x, sample.y, sample.z}, data, {e, e * e, e - 1, sample.x});
  };
  const std::vector<double> x = {1.1, -0.4, 0.3}, w = {1, 2, 3, 4};
  const Results want(make(), 1, x, p, w, kAll);
  for (int round = 0; round < 20; ++round) {
    data.push_back(Expr::symbol("unused"));  // else it is the one that was derived before
    p.push_back(0);
    const Function f = make();
    std::barrier start(8);
    std::vector<int> good(8, 0);
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < 8; ++t)
      threads.emplace_back([&, t] {
        start.arrive_and_wait();
        const unsigned mask = t % 7 + 1;
        const Wanted wanted{(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0};
        const Results got(f, 1, x, p, w, wanted);
        const Results all(f, 1, x, p, w, kAll);
        good[t] = (!wanted.values || same_bits(got.values, want.values)) &&
                  same_bits(all.jacobian, want.jacobian) && same_bits(all.hessian, want.hessian);
      });
    for (auto& thread : threads) thread.join();
    ASSERT_EQ(good, std::vector<int>(8, 1));
  }
}

TEST(Function, InstructionsGrowWithWhatIsWanted) {
  const Function f = Sample().make();
  const auto values = f.instructions({.values = true});
  const auto jacobian = f.instructions({.values = true, .jacobian = true});
  EXPECT_GT(values, 0u);
  EXPECT_GT(jacobian, values);
  EXPECT_GT(f.instructions(kAll), jacobian);
}

TEST(Function, AMillionTermsTakeSeconds) {
  const Timer timer;
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  constexpr int n = kSanitized ? 100'000 : 1'000'000;
  Expr sum;
  for (int i = 0; i < n; ++i) sum += (i % 2 == 0 ? x : y) * (1 + i % 1000);
  const Function f({x, y}, {}, {sum});
  std::vector<double> value(1);
  f(std::vector<double>{1, 0}, {}, value);
  EXPECT_DOUBLE_EQ(value[0], n / 1000 * (499.0 * 500 + 500));
  EXPECT_LT(timer.cpu(), 60) << "not quadratic; a few seconds in a Release build";
}

/// Sizes a hundred times apart may differ a few hundred times in time, not ten thousand times.
TEST(Function, DerivativesOfLargeGraphsAreNotQuadratic) {
  constexpr std::size_t n = kSanitized ? 3'000 : 10'000;
  std::vector<Expr> x;
  for (std::size_t i = 0; i < n; ++i) x.push_back(Expr::symbol("x"));
  Expr chained, chain = x[0];
  for (std::size_t i = 1; i < n; ++i) {
    chained += square(sin(x[i]) - x[i - 1]) / (1 + square(x[i]));
    chain = sin(chain) + 1e-3 * x[0];
  }
  const Timer timer;
  const Function sums(x, {}, {chained});
  EXPECT_EQ(sums.jacobian_pattern().size(), n);
  EXPECT_EQ(sums.hessian_pattern().size(), 2 * n - 1);
  const Function chains({x[0]}, {}, {chain});
  EXPECT_EQ(chains.jacobian_pattern().size(), 1u);
  EXPECT_EQ(chains.hessian_pattern().size(), 1u);
  EXPECT_LT(timer.cpu(), 90) << "about a second in a Release build";
}

}  // namespace
}  // namespace slalom::expr
