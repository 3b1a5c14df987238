// Many solves of one problem give what each would by itself.

#include "slalom/ocp/many.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "ocp/closed_forms.hpp"
#include "ocp/messages.hpp"

namespace slalom::ocp {
namespace {

using test::refusal;

/// Least energy from rest at 0 to rest at `end` in the time 1, with a force that a parameter
/// scales: the objective is 6 (end / gain)^2.
Problem pushed(Bounds where = {}) {
  Problem p("pushed");
  const Expr gain = p.parameter("gain", 1);
  const Expr x = p.state("x", where), v = p.state("v"), u = p.control("u");
  p.dynamics(x, v);
  p.dynamics(v, gain * u);
  p.lagrange("effort", square(u) / 2);
  p.fix(x, 0, 1);
  p.fix(v, 0, 0);
  return p;
}

std::vector<Variation> some() {
  return {{"gain", {1, 2, 0.5, 3, 1.5, 0.25, 4}}, {"final x", {1, -1, 2, 3, 5, 1, 0.5}}};
}

TEST(ManySolves, ComeToTheirClosedForms) {
  const auto given = some();
  const auto answers = solve_many(pushed(), {.mesh = Mesh::uniform(10)}, given);
  ASSERT_EQ(answers.size(), 7u);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const double gain = given[0].values[i], end = given[1].values[i];
    ASSERT_TRUE(answers[i].solved()) << i;
    EXPECT_NEAR(answers[i].objective, 6 * end * end / (gain * gain), 1e-6 * end * end / gain) << i;
    EXPECT_EQ(answers[i].state("x").back(), end);
  }
}

TEST(ManySolves, GiveTheSameBitsOnAnyNumberOfThreads) {
  const SolveSettings settings{.mesh = Mesh::uniform(20), .scheme = lgr(3)};
  const auto alone = solve_many(pushed(), settings, some(), 1);
  for (const int threads : {2, 5, 0}) {
    const auto together = solve_many(pushed(), settings, some(), threads);
    for (std::size_t i = 0; i < alone.size(); ++i)
      EXPECT_EQ(together[i].point.x, alone[i].point.x) << i << " on " << threads;
  }
  // And whichever are solved beside it.
  const auto last = solve_many(pushed(), settings, {{"gain", {4}}, {"final x", {0.5}}}, 1);
  EXPECT_EQ(last[0].point.x, alone[6].point.x);
}

TEST(ManySolves, StartFromASolutionGiven) {
  const SolveSettings cold{.mesh = Mesh::uniform(20)};
  const Solution nominal = solve(pushed(), cold);
  SolveSettings warm = cold;
  warm.previous = &nominal;
  const std::vector<Variation> near{{"gain", {1.01, 0.99}}};
  const auto answers = solve_many(pushed(), warm, near);
  for (const auto& answer : answers) {
    ASSERT_TRUE(answer.solved());
    EXPECT_TRUE(answer.options.warm_start);
  }
  EXPECT_NEAR(answers[0].objective, 6 / (1.01 * 1.01), 1e-6);
}

TEST(ManySolves, EndSoonWhenAskedOnTheCallersThread) {
  struct Asked {
    std::thread::id caller = std::this_thread::get_id();
    int times = 0;
    std::atomic<bool> elsewhere = false;
  } asked;
  SolveSettings settings{.mesh = Mesh::uniform(40)};
  settings.options.stop_data = &asked;
  settings.options.stop = [](void* data) {
    auto& a = *static_cast<Asked*>(data);
    if (std::this_thread::get_id() != a.caller) a.elsewhere = true;
    return ++a.times > 10;
  };
  const std::vector<double> gains(200, 1.5);
  const auto answers = solve_many(pushed(), settings, {{"gain", gains}}, 2);
  EXPECT_FALSE(asked.elsewhere);
  ASSERT_EQ(answers.size(), 200u);
  EXPECT_EQ(answers.back().status, nlp::Status::interrupted);
  EXPECT_TRUE(answers.back().trajectory.tau.empty());  // not begun
}

TEST(ManySolves, SayWhichSolveIsAtFault) {
  const Problem p = pushed({-10, 10});
  EXPECT_NE(refusal([&] {
              (void)solve_many(p, {}, {{"final x", {1, 2, 30}}}, 2);
            }).find("solve 2 of many"),
            std::string::npos);
}

TEST(ManySolves, RefuseWhatIsNotThere) {
  const Problem p = pushed();
  const auto says = [&](const std::vector<Variation>& given, const std::string& text,
                        int threads = 1) {
    EXPECT_NE(refusal([&] { (void)solve_many(p, {}, given, threads); }).find(text),
              std::string::npos)
        << refusal([&] { (void)solve_many(p, {}, given, threads); });
  };
  says({{"gian", {1}}}, "pushed: many: found no number 'gian', expected perhaps 'gain'");
  says({{"initial y", {1}}}, "perhaps 'initial x'");
  says({{"gain", {1, 2}}, {"final x", {1}}},
       "final x: found 1 numbers, expected 2, as many as of gain");
  says({{"gain", {1, NAN}}}, "gain[1]: found nan, expected a finite number");
  says({{"gain", {1}}}, "threads: found -1", -1);
  EXPECT_NE(refusal([&] {
              (void)solve_many(pushed({-9, 9}), {}, {{"upper x", {1}}});
            }).find("upper x: found 1, expected a number that may be set"),
            std::string::npos);
  EXPECT_TRUE(solve_many(p, {}, {}, 1).empty());
}

}  // namespace
}  // namespace slalom::ocp
