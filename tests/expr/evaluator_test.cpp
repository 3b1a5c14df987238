// Evaluator gives Function's numbers, whatever is asked for together, moved or used again.

#include "slalom/expr/evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <random>
#include <utility>

#include "slalom/base/kernels.hpp"
#include "support/kernel_sets.hpp"

namespace slalom::expr {
namespace {

using Vector = std::vector<double>;

constexpr Wanted kAll{.values = true, .jacobian = true, .hessian = true};

std::vector<Wanted> combinations() {
  std::vector<Wanted> list;
  for (int mask = 1; mask < 8; ++mask)
    list.push_back({(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0});
  return list;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// Of three variables and two data, with parts that depend on data alone.
struct Sample {
  Expr x = Expr::symbol("x"), y = Expr::symbol("y"), z = Expr::symbol("z"), p = Expr::symbol("p"),
       q = Expr::symbol("q");
  Function function{{x, y, z},
                    {p, q},
                    {sin(x * y) / (2 + z * z) * exp(p * q), pow(abs(x) + 1, p) + tanh(z) * cos(q),
                     atan2(y, x) * p, exp(p) + sin(q)}};
  std::size_t lanes;
  Vector variables, data, weights;

  explicit Sample(std::size_t count) : lanes(count) {
    std::mt19937 random(static_cast<unsigned>(count));
    std::uniform_real_distribution<double> uniform(0.2, 1.5);
    const auto fill = [&](Vector& v, std::size_t n) {
      v.resize(n * lanes);
      for (double& number : v) number = uniform(random);
    };
    fill(variables, 3);
    fill(data, 2);
    fill(weights, 4);
  }
  void load(Evaluator& e) const {
    for (std::size_t i = 0; i < 3; ++i) e.set_variable(i, variables.data() + i * lanes, false);
    std::copy(data.begin(), data.end(), e.data().begin());
    std::copy(weights.begin(), weights.end(), e.weights().begin());
    e.data_changed();
  }
  struct Results {
    Vector values, jacobian, hessian;
  };
  Results expected() const {
    Results r{Vector(4 * lanes), Vector(function.jacobian_pattern().size() * lanes),
              Vector(function.hessian_pattern().size() * lanes)};
    function.evaluate(lanes, variables, data, weights, kAll, r.values, r.jacobian, r.hessian);
    return r;
  }
};

void expect_results(const Evaluator& e, const Sample::Results& r, Wanted wanted) {
  if (wanted.values) {
    EXPECT_TRUE(same_bits(e.values(), r.values));
  }
  if (wanted.jacobian) {
    EXPECT_TRUE(same_bits(e.jacobian(), r.jacobian));
  }
  if (wanted.hessian) {
    EXPECT_TRUE(same_bits(e.hessian(), r.hessian));
  }
}

class EvaluatorTest : public OnKernelSet {};

TEST_P(EvaluatorTest, GivesTheBitsOfFunctionWhateverIsAskedForTogether) {
  for (const std::size_t lanes : {1u, 2u, 3u, 4u, 7u, 8u, 16u, 61u, 600u}) {
    const Sample sample(lanes);
    const auto expected = sample.expected();
    for (const Wanted wanted : combinations()) {
      Evaluator e(sample.function, lanes);
      sample.load(e);
      e.evaluate(wanted);
      expect_results(e, expected, wanted);
    }
    Evaluator one(sample.function, lanes);  // asked for one after the other
    sample.load(one);
    for (const Wanted wanted : combinations()) {
      one.evaluate(wanted);
      expect_results(one, expected, wanted);
    }
    expect_results(one, expected, kAll);
  }
}

TEST_P(EvaluatorTest, WhatDependsOnDataAloneFollowsTheDataWhenTold) {
  Sample sample(9);
  Evaluator e(sample.function, sample.lanes);
  sample.load(e);
  e.evaluate(kAll);
  for (double& d : sample.data) d *= 0.7;
  std::copy(sample.data.begin(), sample.data.end(), e.data().begin());
  e.data_changed();
  e.evaluate(kAll);
  expect_results(e, sample.expected(), kAll);
}

TEST_P(EvaluatorTest, ReadsVariablesWhereTheyStand) {
  Sample sample(11);
  Evaluator e(sample.function, sample.lanes);
  sample.load(e);
  e.evaluate(kAll);
  for (double& v : sample.variables) v += 0.1;  // in place, without another call
  e.evaluate(kAll);
  expect_results(e, sample.expected(), kAll);
}

TEST_P(EvaluatorTest, OneNumberStandsForAllLanes) {
  for (const std::size_t lanes : {1u, 3u, 4u, 9u, 130u}) {
    Sample sample(lanes);
    const double y = 0.8;
    std::fill_n(sample.variables.begin() + static_cast<std::ptrdiff_t>(lanes), lanes, y);
    Evaluator e(sample.function, lanes);
    sample.load(e);
    e.set_variable(1, &y, true);
    e.evaluate(kAll);
    expect_results(e, sample.expected(), kAll);
    e.set_variable(1, sample.variables.data() + lanes, false);  // and back
    e.evaluate(kAll);
    expect_results(e, sample.expected(), kAll);
  }
}

TEST_P(EvaluatorTest, MovesWithAllItKnows) {
  const Sample sample(13);
  const auto expected = sample.expected();
  Evaluator first(sample.function, sample.lanes);
  sample.load(first);
  first.prepare(kAll);
  first.evaluate({.values = true});
  Evaluator second(std::move(first));
  second.evaluate(kAll);
  expect_results(second, expected, kAll);
  Evaluator third(sample.function, 2);
  third = std::move(second);
  EXPECT_EQ(third.lanes(), sample.lanes);
  third.evaluate({.hessian = true});
  third.evaluate({.values = true, .jacobian = true});
  expect_results(third, expected, kAll);
}

TEST_P(EvaluatorTest, OutlivesItsFunction) {
  std::optional<Sample> sample(std::in_place, 5);
  const auto expected = sample->expected();
  const Vector variables = sample->variables;
  Evaluator e(sample->function, 5);
  sample->load(e);
  for (std::size_t i = 0; i < 3; ++i) e.set_variable(i, variables.data() + i * 5, false);
  sample.reset();
  e.evaluate(kAll);
  expect_results(e, expected, kAll);
}

TEST_P(EvaluatorTest, NoLanesAndNothingWanted) {
  const Sample sample(3);
  Evaluator none(sample.function, 0);
  none.prepare(kAll);
  none.data_changed();
  none.evaluate(kAll);
  EXPECT_TRUE(none.values().empty());
  Evaluator e(sample.function, 3);
  sample.load(e);
  e.evaluate(kAll);
  e.evaluate({.values = false});  // leaves what was
  expect_results(e, sample.expected(), kAll);
}

INSTANTIATE_TEST_SUITE_P(Sets, EvaluatorTest, each_kernel_set(), name_of_set);

}  // namespace
}  // namespace slalom::expr
