// A problem solved again and again gives what solving it anew would.

#include "slalom/ocp/prepared.hpp"

#include <gtest/gtest.h>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

TEST(PreparedProblems, FollowChangedNumbersWithOneTranscription) {
  auto form = least_energy();
  Problem& p = form.problem;
  const Expr x = p.states()[0].symbol;
  p.final_bounds(x, Bounds::equal(7));
  Prepared prepared(p, {.mesh = Mesh::uniform(10)});
  const auto units = prepared.solve().state_units;
  for (const double end : {1.0, 2.0, -300.0}) {
    p.final_bounds(x, Bounds::equal(end));
    prepared.update(p);
    const Solution again = prepared.solve();
    ASSERT_TRUE(again.solved());
    EXPECT_NEAR(again.objective, 6 * end * end, 1e-6 * end * end);
    EXPECT_EQ(again.state_units, units);  // found once
    EXPECT_EQ(again.state("x").back(), end);
  }
}

/// Nothing that the guess tells gives the row a scale.
TEST(PreparedProblems, FollowChangedNumbersBesideARowWithoutAScale) {
  auto form = least_energy();
  Problem& p = form.problem;
  const Expr x = p.states()[0].symbol;
  const Expr q = p.integral("q", square(x) / 1e6);
  p.boundary("room", q - 1, Bounds::at_most(0));
  p.final_bounds(x, Bounds::equal(7));
  Prepared prepared(p, {.mesh = Mesh::uniform(10)});
  const auto units = prepared.solve().state_units;
  p.final_bounds(x, Bounds::equal(300));
  prepared.update(p);
  const Solution again = prepared.solve();
  ASSERT_TRUE(again.solved());
  EXPECT_EQ(again.state_units, units);
}

TEST(PreparedProblems, TranscribeAnewWhatAnUpdateCannotCarry) {
  Problem p = bryson_denham(1.0 / 9).problem;
  const auto wall = p.path("wall", p.states()[1].symbol, Bounds::at_least(-0.5));
  p.enable(wall, false);
  Prepared prepared(p, {.mesh = Mesh::uniform(30)});
  const double without = prepared.solve().objective;
  p.final_bounds(p.states()[1].symbol, Bounds{});
  p.enable(wall, true);
  prepared.update(p);
  const Solution with = prepared.solve();
  ASSERT_TRUE(with.solved());
  EXPECT_LT(with.objective, without);
  EXPECT_NEAR(with.objective, solve(p, {.mesh = Mesh::uniform(30)}).objective, 1e-6);
  EXPECT_EQ(with.multiplier("wall").values.size(), 61u);
}

/// A row's bounds are part of the structure: a problem stated with others is transcribed anew.
TEST(PreparedProblems, TakeARowsOtherBounds) {
  const auto limited = [](double most) {
    Problem p = bryson_denham(1.0).problem;  // its own limit is far off
    p.path("wall", p.states()[0].symbol, Bounds::at_most(most));
    return p;
  };
  Prepared prepared(limited(1.0 / 6), {.mesh = Mesh::uniform(30)});
  const double loose = prepared.solve().objective;
  prepared.update(limited(1.0 / 9));
  const double tight = prepared.solve().objective;
  EXPECT_GT(tight, loose + 0.1);
  EXPECT_NEAR(tight, solve(limited(1.0 / 9), {.mesh = Mesh::uniform(30)}).objective, 1e-6);
}

TEST(PreparedProblems, RefuseABadUpdateAndGoOnAfterAGoodOne) {
  auto form = least_energy();
  Problem& p = form.problem;
  const Expr x = p.states()[0].symbol;
  Prepared prepared(p, {.mesh = Mesh::uniform(10)});
  Problem bad = p;
  bad.path("wall", Expr::symbol("foreign"), Bounds::at_least(0));
  EXPECT_NE(refusal([&] { prepared.update(bad); }).find("wall: found the symbol 'foreign'"),
            std::string::npos);
  p.final_bounds(x, Bounds::equal(2));
  prepared.update(p);
  EXPECT_NEAR(prepared.solve().objective, 24, 1e-5);
}

TEST(PreparedProblems, TakeGuessesAndOptions) {
  const auto form = brachistochrone();
  Prepared prepared(form.problem, {.guess = form.guess});
  EXPECT_NEAR(prepared.solve(form.guess).objective, form.objective, 1e-6);
  auto options = prepared.options();
  options.max_iterations = 1;
  prepared.set_options(options);
  EXPECT_EQ(prepared.solve(form.guess).status, nlp::Status::iteration_limit);
  Trajectory bad = form.guess;
  bad.states.pop_back();
  EXPECT_NE(refusal([&] { (void)prepared.solve(bad); }), "accepted");
}

}  // namespace
}  // namespace slalom::ocp
