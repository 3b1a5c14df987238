#include "slalom/io/paper_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "files.hpp"
#include "slalom/io/scenario_file.hpp"
#include "slalom/sim/drive.hpp"

namespace slalom::io {
namespace {

TEST(PaperData, HasTheTenDrivesAndTheirFigures) {
  const auto paper = load_paper_data();
  std::set<std::string> drives;
  for (const auto& drive : paper.drives) {
    drives.insert(drive.environment + "/" + drive.planner);
    const auto& outcomes = sim::outcome_names();
    EXPECT_NE(std::find(outcomes.begin(), outcomes.end(), drive.outcome), outcomes.end())
        << drive.outcome;
    EXPECT_NO_THROW(load_scenario({drive.environment, drive.planner, {}, {}}));
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

}  // namespace
}  // namespace slalom::io
