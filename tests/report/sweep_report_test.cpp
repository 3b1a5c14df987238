#include "slalom/report/sweep_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "report/markup.hpp"

namespace slalom::report {
namespace {

TrialRecord trial(std::int64_t number, const char* planner, const char* tex, const char* vy,
                  const char* outcome, double solve = 0.1) {
  TrialRecord r;
  r.trial = number;
  r.scenario = "E_C";
  r.planner = planner;
  r.values = {tex, vy};
  r.outcome = outcome;
  r.hit = r.outcome == "crash" ? "O<2>" : "";
  r.time = 20;
  r.least_clearance = 0.25;
  r.max_solve_time = 2 * solve;
  r.max_cpu_time = solve;
  return r;
}

/// Two planners over two horizons and three speeds, one trial missing, one failed.
SweepTable small_sweep() {
  SweepTable t;
  t.name = "a & b";
  t.title = "small <study>";
  t.scenarios = {"E_C"};
  t.planners = {"P_C", "P_D"};
  t.columns = {"loop.tex", "obstacles.O2.vy"};
  t.size = 12;
  t.trials = {
      trial(1, "P_C", "0.5", "0", "goal"),         trial(2, "P_C", "0.5", "-10", "crash", 0.2),
      trial(3, "P_C", "0.5", "-20", "crash", 0.3), trial(4, "P_C", "1", "0", "not_optimal"),
      trial(5, "P_C", "1", "-10", "crash"),        trial(7, "P_D", "0.5", "0", "goal"),
      trial(8, "P_D", "0.5", "-10", "goal", 0.6),  trial(9, "P_D", "0.5", "-20", "failed"),
      trial(10, "P_D", "1", "0", "goal"),          trial(11, "P_D", "1", "-10", "wheel_lift"),
      trial(12, "P_D", "1", "-20", "timeout")};
  auto& failed = t.trials[7];
  failed.max_solve_time = failed.max_cpu_time = failed.time = TrialRecord::kNone;
  return t;
}

TEST(SweepCounts, PassesArePerPlanner) {
  const auto counts = pass_counts(small_sweep());
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts[0].planner, "P_C");
  EXPECT_EQ(counts[0].passed, 1);
  EXPECT_EQ(counts[0].trials, 5);
  EXPECT_EQ(counts[1].passed, 3);
  EXPECT_EQ(counts[1].trials, 6);
}

TEST(SweepCounts, PairsAreTrialsThatDifferInThePlannerAlone) {
  const auto pairs = pair_count(small_sweep(), "P_C", "P_D");
  EXPECT_EQ(pairs.both, 1);
  EXPECT_EQ(pairs.only1, 0);
  EXPECT_EQ(pairs.only2, 2);    // (0.5, -10) and (1, 0)
  EXPECT_EQ(pairs.neither, 2);  // (0.5, -20) and (1, -10); (1, -20) has no partner
}

/// The small sweep in a second scenario too, where P_C always arrives and P_D always crashes.
SweepTable two_scenarios() {
  auto t = small_sweep();
  t.scenarios = {"E_C", "a<b"};
  const auto first = t.trials;
  for (auto record : first) {
    record.scenario = "a<b";
    record.trial += 12;
    record.outcome = record.planner == "P_C" ? "goal" : "crash";
    t.trials.push_back(record);
  }
  t.size = 24;
  return t;
}

TEST(SweepCounts, PairsStandInOneScenario) {
  const auto pairs = pair_count(two_scenarios(), "P_C", "P_D");
  EXPECT_EQ(pairs.both, 1);
  EXPECT_EQ(pairs.only1, 5);
  EXPECT_EQ(pairs.only2, 2);
  EXPECT_EQ(pairs.neither, 2);
}

TEST(SweepCounts, EachScenarioHasItsCounts) {
  auto sweep = two_scenarios();
  sweep.scenarios.emplace_back("not begun");
  const auto counts = scenario_counts(sweep);
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts[0].planners[1].passed, 3);
  EXPECT_EQ(counts[1].scenario, "a<b");
  EXPECT_EQ(counts[1].planners[0].passed, 5);
  EXPECT_EQ(counts[1].planners[1].planner, "P_D");
  EXPECT_EQ(counts[1].planners[1].passed, 0);
  EXPECT_EQ(counts[1].planners[1].trials, 6);
}

TEST(SweepCounts, RealTimeFactorIsTheMeanOverSpeedsOfTheLongestSolve) {
  const auto rows = horizon_rows(small_sweep(), "P_C");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].tex, 0.5);
  EXPECT_NEAR(rows[0].rtf_cpu, (0.1 + 0.2 + 0.3) / 3 / 0.5, 1e-12);
  EXPECT_NEAR(rows[0].rtf, 2 * rows[0].rtf_cpu, 1e-12);
  EXPECT_NEAR(rows[0].pos(), 1.0 / 3, 1e-12);
  EXPECT_EQ(rows[1].trials, 2);
  EXPECT_EQ(rows[1].pos(), 0);
}

TEST(SweepCounts, FasterObstaclesAreLeftOutAndFailedTrialsCountAsNotPassed) {
  const auto all = horizon_rows(small_sweep(), "P_D");
  EXPECT_NEAR(all[0].pos(), 2.0 / 3, 1e-12);
  EXPECT_NEAR(all[0].rtf_cpu, (0.1 + 0.6) / 2 / 0.5, 1e-12);
  const auto slow = horizon_rows(small_sweep(), "P_D", 10);
  EXPECT_EQ(slow[0].pos(), 1);
  EXPECT_EQ(slow[0].trials, 2);
}

TEST(SweepCounts, TheLongestHorizonIsOneBelowWhichAllAreAsGood) {
  const auto rows = longest_horizons(small_sweep());
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].key, "obstacles.O2.vy");
  EXPECT_EQ(rows[0].value, -20);
  EXPECT_TRUE(std::isnan(rows[0].planners[1].tex));  // none arrives
  EXPECT_EQ(rows[0].planners[1].best, 0);
  EXPECT_EQ(rows[1].planners[1].tex, 0.5);  // P_D at -10: at .5 alone
  EXPECT_EQ(rows[1].planners[1].best, 1);
  EXPECT_EQ(rows[2].planners[1].tex, 1);  // P_D at 0: at both
  EXPECT_EQ(rows[2].planners[1].best, 2);
  EXPECT_EQ(rows[2].horizons, 2);
  auto longer = small_sweep();
  longer.trials[0].outcome = "crash";
  longer.trials[3].outcome = "goal";  // P_C at 0: at 1 alone, not at the shortest
  EXPECT_TRUE(std::isnan(longest_horizons(longer)[2].planners[0].tex));
  EXPECT_EQ(longest_horizons(longer)[2].planners[0].best, 1);
  longer.columns[0] = "planner.w_t";
  EXPECT_TRUE(longest_horizons(longer).empty());
}

TEST(SweepFigures, MarksNameTheirTrials) {
  const auto figures = sweep_figures(small_sweep());
  EXPECT_NE(figures[0].svg.find("data-mark=\"5\""), std::string::npos);
  EXPECT_EQ(figures[0].svg.find("data-mark=\"7\""), std::string::npos);  // the other planner's
  EXPECT_NE(figures[1].svg.find("data-mark=\"7\""), std::string::npos);
}

TEST(SweepFigures, EachPlannerHasAMapAndAllShareOneOfTheHorizons) {
  const auto figures = sweep_figures(small_sweep());
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures[0].file, "map_P_C.svg");
  EXPECT_EQ(figures[2].file, "real_time.svg");
  for (const auto& figure : figures) EXPECT_NO_THROW((void)testing::parse_xml(figure.svg));
  // A study without a second axis has no map, one without tex no figure of it.
  auto other = small_sweep();
  other.columns = {"planner.w_t", "start.x"};
  EXPECT_EQ(sweep_figures(other).size(), 2U);
  for (auto& record : other.trials) record.values = {"5", "1"};
  EXPECT_TRUE(sweep_figures(other).empty());
}

TEST(SweepPage, ShowsCountsTestsAndThePapersBesideThem) {
  PublishedSweep paper;
  paper.counts = {{"P_C", 22, 400}, {"P_D", 148, 400}};
  paper.notes = {{"counts", "a note on counts"}};
  auto sweep = small_sweep();
  const auto page = sweep_page(sweep, paper);
  for (const char* part : {"a &amp; b", "small &lt;study&gt;", "22 of 400 (5.5 %)", "1.3e-29",
                           "a note on counts", "crash O&lt;2&gt;", "11 <small>of 12</small>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("<study>"), std::string::npos);
  EXPECT_EQ(page.find("O<2>"), std::string::npos);  // nor in the data of the script
  EXPECT_EQ(page.find("http://"), page.find("http://www.w3.org"));
  // Elsewhere the paper has nothing to say.
  sweep.scenarios = {"E_B"};
  EXPECT_EQ(sweep_page(sweep, paper).find("22 of 400"), std::string::npos);
}

TEST(SweepPage, CountsTheCyclesThatFailedByPlanner) {
  auto sweep = small_sweep();
  for (auto& record : sweep.trials) record.cycles = 40;
  sweep.trials[1].failed_cycles = 2;
  sweep.trials[4].failed_cycles = 5;
  sweep.trials[0].new_plans = 3;
  sweep.trials[1].rests = 37;
  const auto page = sweep_page(sweep, {});
  EXPECT_EQ(testing::count(page,
                           "<td class=\"num\">7 of 200</td><td class=\"num\">2 of 5</td>"
                           "<td class=\"num\">3</td><td class=\"num\">37</td>"
                           "<td class=\"num\">0</td>"),
            1);
  EXPECT_EQ(testing::count(page, "<td class=\"num\">0 of 240</td><td class=\"num\">0 of 6</td>"),
            1);
}

TEST(SweepPage, SeveralScenariosStandSideBySide) {
  const auto page = sweep_page(two_scenarios(), {});
  for (const char* part : {"Scenarios E_C, a&lt;b,", "At the goal, by scenario", "0 of 6"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(sweep_page(small_sweep(), {}).find("by scenario"), std::string::npos);
  auto many = small_sweep();
  for (int i = 0; i < 999; ++i) many.scenarios.push_back("s" + std::to_string(i));
  EXPECT_NE(sweep_page(many, {}).find("1000 scenarios, "), std::string::npos);
}

TEST(SweepPage, ASweepWithoutTrialsHasAPage) {
  auto sweep = small_sweep();
  sweep.trials.clear();
  EXPECT_NE(sweep_page(sweep, {}).find("0 <small>of 12</small>"), std::string::npos);
}

}  // namespace
}  // namespace slalom::report
