#include "../../src/expr/tape.hpp"

#include <gtest/gtest.h>

#include "expr/reference.hpp"

namespace slalom::expr {
namespace {

TEST(Tape, RowsAreReusedOnceRead) {
  Dag dag;
  auto id = dag.input(0);
  for (int i = 0; i < 1000; ++i) id = dag.apply(i % 2 == 0 ? Op::sin : Op::exp, id);
  const Tape tape = compile(dag, {id});
  EXPECT_EQ(tape.code.size(), 1000u);
  EXPECT_EQ(tape.rows, 2u) << "a chain needs one row besides its input's";
}

TEST(Tape, WhatIsNotAskedForIsNotComputed) {
  Dag dag;
  const auto x = dag.input(0), y = dag.input(1);
  dag.apply(Op::sin, y);
  const Tape tape = compile(dag, {dag.apply(Op::cos, x)});
  EXPECT_EQ(tape.code.size(), 1u);
  ASSERT_EQ(tape.inputs.size(), 1u);
  EXPECT_EQ(tape.inputs[0].input, 0u);
}

TEST(Tape, AConstantsRowIsNeverReused) {
  Dag dag;
  const auto x = dag.input(0);
  auto id = dag.scale(3, x);
  for (int i = 0; i < 20; ++i) id = dag.apply(Op::sin, dag.add(id, dag.apply(Op::cos, id)));
  const Tape tape = compile(dag, {id});
  ASSERT_EQ(tape.constants.size(), 1u);
  for (const auto& step : tape.code) EXPECT_NE(step.to, tape.constants[0].row);
}

TEST(Tape, AResultOutlivesItsReaders) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y"), s = sin(x);
  // Results: an intermediate, an input, a constant, one vertex twice, and what reads them.
  const std::vector<Expr> outputs = {s, x, 4, s, exp(s) + cos(s * y), y, x * y};
  const Function f({x, y}, {}, outputs);
  std::vector<double> got(outputs.size());
  f(std::vector<double>{0.4, 1.3}, {}, got);
  const auto want = reference::values<double>(outputs, {x, y}, {0.4, 1.3});
  for (std::size_t k = 0; k < got.size(); ++k) EXPECT_LE(reference::ulps(got[k], want[k]), 4) << k;
}

}  // namespace
}  // namespace slalom::expr
