#include "../../src/paper/paper_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "io/files.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sim/drive.hpp"

namespace slalom::paper {
namespace {

TEST(PaperData, HasTheTenDrivesAndTheirFigures) {
  const auto paper = load_paper_data();
  std::set<std::string> drives;
  for (const auto& drive : paper.drives) {
    drives.insert(drive.environment + "/" + drive.planner);
    const auto& outcomes = sim::outcome_names();
    EXPECT_NE(std::find(outcomes.begin(), outcomes.end(), drive.outcome), outcomes.end())
        << drive.outcome;
    EXPECT_NO_THROW(io::load_scenario({drive.environment, drive.planner, {}, {}}));
  }
  EXPECT_EQ(drives.size(), 10U);
  const auto& last = paper.drives.back();
  EXPECT_EQ(last.environment + "/" + last.planner, "E_C/P_D");
  EXPECT_EQ(last.time, 28.5);
  ASSERT_EQ(last.snapshots.size(), 4U);
  EXPECT_EQ(last.snapshots[2].tolerance, 5);
  EXPECT_TRUE(std::isnan(last.end_ux)) << "a key left out keeps its default";
  EXPECT_EQ(paper.effort_P_B.total, 0.532);
  EXPECT_EQ(paper.effort_P_C.jerk, 0.42);
  EXPECT_FALSE(paper.notes.empty());
  for (const auto& note : paper.notes) EXPECT_FALSE(note.text.empty()) << note.topic;
}

TEST(PaperData, HasTheSixCasesWithTheirScenarios) {
  const auto cases = load_concept_cases({.tex = 0.25, .overrides = {"planner.w_haf=2"}});
  std::string names;
  for (const auto& one : cases) {
    names += one.name;
    EXPECT_EQ(one.driven.folder, "cases/" + one.name);
    EXPECT_EQ(one.driven.scenario.loop.tex, 0.25);
    EXPECT_EQ(one.driven.scenario.planner.w_haf, 2);
    const auto& outcomes = sim::outcome_names();
    EXPECT_NE(std::find(outcomes.begin(), outcomes.end(), one.outcome), outcomes.end());
    if (!one.faster_than.empty()) EXPECT_NE(names.find(one.faster_than), names.npos);
  }
  ASSERT_EQ(names, "ABCDEF");
  const auto planner = [&](std::size_t i) { return cases[i].driven.scenario.planner; };
  EXPECT_EQ(planner(0).model, vehicle::ModelKind::kinematic);
  EXPECT_EQ(planner(1).w_t, 0);
  EXPECT_EQ(planner(2).model, vehicle::ModelKind::constant_speed);
  EXPECT_EQ(planner(3).w_ce, 1);
  EXPECT_FALSE(planner(4).moving_avoidance);
  EXPECT_TRUE(planner(5).moving_avoidance);
}

TEST(PaperData, CasesYieldToTheCommandLine) {
  const auto cases = load_concept_cases({.overrides = {"planner.model=linear_tyre"}});
  for (const auto& one : cases)
    EXPECT_EQ(one.driven.scenario.planner.model, vehicle::ModelKind::linear_tyre) << one.name;
}

}  // namespace
}  // namespace slalom::paper
