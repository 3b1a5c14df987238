// A transcription that takes over other numbers one after the other, against one made of them.

#include <gtest/gtest.h>

#include "ocp/everything.hpp"
#include "ocp/messages.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::ocp {
namespace {

constexpr nlp::Parts kAll{.values = true, .derivatives = true, .hessian = true};

void expect_same(Transcription& updated, const Problem& problem, const std::string& after) {
  Transcription fresh(problem, Mesh::uniform(4), hermite_simpson());
  std::vector<double> x(fresh.structure().variables), y(fresh.structure().rows);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.3 + 0.01 * static_cast<double>(i % 7);
  for (std::size_t r = 0; r < y.size(); ++r) y[r] = 0.2 * static_cast<double>(r % 5);
  nlp::Evaluation is, expected;
  EXPECT_FALSE(updated.evaluate(x, 1, y, kAll, is)) << after;
  EXPECT_FALSE(fresh.evaluate(x, 1, y, kAll, expected)) << after;
  EXPECT_EQ(is.objective, expected.objective) << after;
  EXPECT_EQ(is.rows, expected.rows) << after;
  EXPECT_EQ(is.gradient, expected.gradient) << after;
  EXPECT_EQ(is.jacobian, expected.jacobian) << after;
  EXPECT_EQ(is.hessian, expected.hessian) << after;
  EXPECT_EQ(updated.limits().xl, fresh.limits().xl) << after;
  EXPECT_EQ(updated.limits().xu, fresh.limits().xu) << after;
  EXPECT_EQ(updated.last_cost_terms(), fresh.cost_terms(x)) << after;
}

TEST(Update, TakesOverEachNumberAloneAndTakesItBack) {
  const Everything all;
  Transcription updated(all.problem, Mesh::uniform(4), hermite_simpson());
  for (const Change& change : all.changes()) {
    if (change.number == "upper disc" || change.number == "upper power" ||
        change.number == "arrival")
      continue;  // bounds of rows are transcribed
    Problem problem = all.problem;
    for (const double by : {0.01, 0.0}) {
      change.add(problem, by);
      updated.update(problem);
      expect_same(updated, problem, change.number);
    }
  }
}

TEST(Update, OneThatIsRefusedLeavesTheNumbersToTheNext) {
  const Everything all;
  Problem problem = all.problem;
  Transcription updated(problem, Mesh::uniform(4), hermite_simpson());
  Problem bad = problem;
  bad.set_parameter(all.mass, 2);
  bad.set_members(all.discs, {"one", "two"}, {{0.2, 0.5, 1, 1}, {-0.3, 0.4}});
  EXPECT_NE(test::refusal([&] { updated.update(bad); }), "accepted");
  expect_same(updated, problem, "refused");
  problem.set_parameter(all.mass, 2);
  updated.update(problem);
  expect_same(updated, problem, "the next");
}

}  // namespace
}  // namespace slalom::ocp
