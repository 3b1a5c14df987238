// What is only rounding in ends and rows is no scale.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "slalom/ocp/guess.hpp"
#include "slalom/ocp/scaling.hpp"
#include "slalom/ocp/solve.hpp"

namespace slalom::ocp {
namespace {

/// A push along a line and back to rest, in these units of length, without bounds of the push.
Problem push(double rest, double unit) {
  Problem p("push");
  const Expr x = p.state("x"), v = p.state("v"), u = p.control("u");
  p.dynamics(x, v);
  p.dynamics(v, u);
  p.fix(x, 0, unit);
  p.fix(v, rest * unit, rest * unit);
  p.final_time(Bounds::equal(2), 2);
  p.lagrange("effort", square(u / unit));
  return p;
}

TEST(Scaling, RoundingAtAnEndIsNoSize) {
  const double rounding = std::sin(std::acos(-1.0));
  for (const double unit : {1.0, 1e6, 1e-6}) {
    SCOPED_TRACE(unit);
    const Solution exact = solve(push(0, unit)), near = solve(push(rounding, unit));
    ASSERT_TRUE(near.solved()) << nlp::to_string(near.status);
    EXPECT_EQ(near.scales, exact.scales);
    EXPECT_NEAR(near.objective, 1.5, 1e-6);
  }
}

TEST(Scaling, RoundingAtAnEndIsNoSizeWhereNothingElseIsKnown) {
  const auto units = [](double end, Bounds bounds) {
    Problem p("nothing else");
    const Expr x = p.state("x", bounds), u = p.control("u");
    p.dynamics(x, u);
    p.fix(x, 0, end);
    const Problem scaled = with_scales(p, Guess(p).trajectory());
    return std::pair(scaled.states()[0].unit(), scaled.controls()[0].unit());
  };
  EXPECT_EQ(units(1e-16, {}), units(0, {}));
  EXPECT_EQ(units(1e-16, {-5, 5}).first, 5);
  EXPECT_EQ(units(1e-9, {-5, 5}).first, 1e-9) << "is no rounding";
}

/// What a row's two ends make of it together may be rounding alone.
TEST(Scaling, RoundingIsNoSizeOfARow) {
  for (const double begin : {0.0, 0.1, 0.3, 1e6 + 0.1}) {
    SCOPED_TRACE(begin);
    Problem p("around");
    const Expr x = p.state("x", {-7, 7}), u = p.control("u", {-1, 1});
    p.dynamics(x, u);
    p.initial_bounds(x, {begin - 0.7, begin + 0.7});
    p.boundary("periodic", p.final(x) - p.initial(x), Bounds::equal(0));
    const Trajectory guess{0, 2, {0, 1}, {{begin}, {begin + 1e-17}}, {{0}, {0}}, {}, {}};
    const Problem scaled = with_scales(p, guess);
    EXPECT_NEAR(scaled.constraints()[0].scale, 0.5 * scaled.states()[0].unit(), 1e-3);
  }
}

}  // namespace
}  // namespace slalom::ocp
