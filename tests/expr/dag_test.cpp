#include "../../src/expr/dag.hpp"

#include <gtest/gtest.h>

#include "expr/reference.hpp"
#include "slalom/base/error.hpp"

namespace slalom::expr {
namespace {

using Id = Dag::Id;

TEST(Dag, EqualSubexpressionsAreOneVertex) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  Dag dag;
  const auto ids =
      dag.import({sin(x * y) + 1, 1 + sin(y * x), cos(x)}, {{x.node(), 0}, {y.node(), 1}});
  EXPECT_EQ(ids[0], ids[1]) << "sums and products in either order";
  EXPECT_NE(ids[0], ids[2]);
  EXPECT_EQ(dag.size(), 7u) << "x, y, xy, sin, 1, the sum, cos";
}

TEST(Dag, ArgumentsHaveSmallerIdsThanTheirUsers) {
  const Expr x = Expr::symbol("x"), y = Expr::symbol("y");
  Dag dag;
  dag.import({select(x, pow(y, 7), -x / y) - atan2(x, y)}, {{x.node(), 0}, {y.node(), 1}});
  for (Id id = 0; id < dag.size(); ++id)
    if (dag[id].op > Op::symbol) {
      EXPECT_LT(dag[id].arg[0], id);
    }
}

TEST(Dag, AnUnknownSymbolIsNamed) {
  const Expr x = Expr::symbol("x"), lost = Expr::symbol("lost");
  Dag dag;
  try {
    dag.import({x + lost}, {{x.node(), 0}});
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'lost'"), std::string::npos) << error.what();
  }
}

TEST(Dag, RulesOfAlgebra) {
  Dag d;
  const Id x = d.input(0), y = d.input(1), zero = d.constant(0), one = d.constant(1);
  const auto neg = [&](Id a) { return d.apply(Op::neg, a); };
  EXPECT_EQ(d.constant(-0.0), zero);
  EXPECT_EQ(d.add(x, zero), x);
  EXPECT_EQ(d.sub(x, zero), x);
  EXPECT_EQ(d.sub(zero, x), neg(x));
  EXPECT_EQ(d.sub(x, x), zero);
  EXPECT_EQ(d.add(x, x), d.scale(2, x));
  EXPECT_EQ(d.add(x, neg(y)), d.sub(x, y));
  EXPECT_EQ(d.add(neg(x), y), d.sub(y, x));
  EXPECT_EQ(d.sub(x, neg(y)), d.add(x, y));
  EXPECT_EQ(neg(neg(x)), x);
  EXPECT_EQ(neg(d.sub(x, y)), d.sub(y, x));
  EXPECT_EQ(neg(d.scale(3, x)), d.scale(-3, x));
  EXPECT_EQ(d.mul(x, zero), zero);
  EXPECT_EQ(d.mul(x, one), x);
  EXPECT_EQ(d.scale(-1, x), neg(x));
  EXPECT_EQ(d.mul(x, x), d.apply(Op::square, x));
  EXPECT_EQ(d.scale(2, d.scale(3, x)), d.scale(6, x));
  EXPECT_EQ(d.mul(neg(x), neg(y)), d.mul(x, y));
  EXPECT_EQ(d.apply(Op::square, neg(x)), d.apply(Op::square, x));
  EXPECT_EQ(d.div(zero, x), zero);
  EXPECT_EQ(d.div(x, one), x);
  EXPECT_EQ(d.div(x, x), one);
  EXPECT_EQ(d.div(x, d.constant(4)), d.scale(0.25, x));
  EXPECT_EQ(d[d.div(x, zero)].op, Op::div) << "no reciprocal that overflows";
  EXPECT_EQ(d[d.div(x, d.constant(1e-310))].op, Op::div) << "no reciprocal that overflows";
  EXPECT_EQ(d.apply(Op::pow, x, d.constant(0.5)), d.apply(Op::sqrt, x));
  EXPECT_EQ(d.apply(Op::pow, x, zero), one);
  EXPECT_EQ(d.apply(Op::min, x, x), x);
}

TEST(Dag, RulesOfSelection) {
  Dag d;
  const Id c = d.input(0), x = d.input(1), y = d.input(2), zero = d.constant(0);
  const auto select = [&](Id a, Id b) { return d.apply(Op::select, c, a, b); };
  EXPECT_EQ(select(x, x), x);
  EXPECT_EQ(select(select(x, y), zero), select(x, zero));
  EXPECT_EQ(select(zero, select(x, y)), select(zero, y));
  EXPECT_EQ(d.apply(Op::select, d.constant(1), x, y), x);
  EXPECT_EQ(d.apply(Op::select, d.constant(0), x, y), y);
  EXPECT_EQ(d.mul(select(x, zero), y), select(d.mul(x, y), zero));
  EXPECT_EQ(d.mul(y, select(zero, x)), select(zero, d.mul(x, y)));
  EXPECT_EQ(d.div(select(x, zero), y), select(d.div(x, y), zero));
  EXPECT_EQ(d.mul(select(x, zero), select(zero, y)), zero) << "sides that exclude each other";
  EXPECT_EQ(d.add(select(x, zero), select(zero, y)), select(x, y));
  EXPECT_EQ(d.apply(Op::neg, select(x, zero)), select(d.apply(Op::neg, x), zero));
  EXPECT_EQ(d[d.mul(select(x, y), y)].op, Op::mul) << "a selection without a zero is left alone";
}

TEST(Dag, ADeepNestOfMasksIsMultipliedWithoutRecursion) {
  Expr nest = Expr::symbol("x");
  const Expr x = nest;
  for (int i = 0; i < 200'000; ++i) nest = select(x - i, nest, 0);
  Dag dag;
  EXPECT_NO_FATAL_FAILURE(dag.import({nest * x * x}, {{x.node(), 0}}));
}

}  // namespace
}  // namespace slalom::expr
