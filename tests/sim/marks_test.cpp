#include "slalom/sim/marks.hpp"

#include <gtest/gtest.h>

#include "sim/fakes.hpp"

namespace slalom::sim {
namespace {

using testing::open_field;
using testing::straight_on;

std::vector<std::string> kinds(const std::vector<Mark>& marks) {
  std::vector<std::string> result;
  for (const auto& mark : marks) result.push_back(mark.kind);
  return result;
}

using Kinds = std::vector<std::string>;

TEST(Marks, ADriveThatIsAsPlannedHasNone) {
  const auto s = open_field();
  EXPECT_EQ(kinds(marks(s, drive(s, straight_on))), Kinds{});
}

TEST(Marks, APlanThatBeginsBesideTheVehicleIsNamedByItsFarthest) {
  const auto s = open_field();
  int cycle = 0;
  const auto beside = [&](const planner::Request& request) {
    auto plan = straight_on(request);
    ++cycle;
    if (cycle == 3) plan.states[0][vehicle::X] -= 0.3;
    if (cycle == 5) plan.states[0][vehicle::PSI] += 0.1;
    if (cycle == 7) plan.states[0][vehicle::Y] += 0.09;  // not worth it
    return plan;
  };
  const auto driven = drive(s, beside);
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), Kinds{"start_slack"});
  EXPECT_EQ(found[0].times,
            (std::vector<double>{driven.cycles[2].t_swap, driven.cycles[4].t_swap}));
  EXPECT_EQ(found[0].text,
            "2 plans begin beside the vehicle, by up to 0.00 m and 5.7 degrees (cycle 5)");
  EXPECT_NEAR(start_slack(driven.cycles[2]).distance, 0.3, 1e-12);
}

TEST(Marks, APlanThroughAnObstacleIsNamedByItsDeepest) {
  const auto s = open_field();
  const auto through = [&](const planner::Request& request) {
    auto plan = straight_on(request);
    plan.report.status = planner::PlanStatus::passes_through;
    plan.report.passage = {request.t0 == 1 ? 2.0 : 0.7, "lorry", request.t0 + 3};
    return plan;
  };
  const auto driven = drive(s, through);
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), Kinds{"passes_through"});
  EXPECT_EQ(found[0].times.size(), driven.cycles.size());
  EXPECT_NE(found[0].text.find("2.00 m into the margin of lorry at 4.00 s (cycle 3)"),
            std::string::npos)
      << found[0].text;
}

TEST(Marks, APlanOffItsRoadIsNamedByItsFarthest) {
  const auto s = open_field();
  const auto off = [&](const planner::Request& request) {
    auto plan = straight_on(request);
    plan.report.status = planner::PlanStatus::passes_through;
    plan.report.passage.depth = s.planner.passage_depth;  // as deep as it may
    plan.report.road_exit = {request.t0 == 1 ? 0.4 : 0.1, request.t0 == 1, request.t0 + 3};
    return plan;
  };
  const auto driven = drive(s, off);
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), Kinds{"plan_off_road"});
  EXPECT_EQ(found[0].times.size(), driven.cycles.size());
  EXPECT_NE(found[0].text.find("plans leave the road between nodes, the farthest by 0.40 m at its "
                               "left edge at 4.00 s (cycle 3)"),
            std::string::npos)
      << found[0].text;
}

TEST(Marks, LimitsThatThePlantBreaksAreNamedOnceForEachWhile) {
  auto s = open_field();
  auto driven = drive(s, straight_on);
  driven.plant.resize(10);
  for (std::size_t k : {2, 3, 6}) driven.plant[k].wheel_loads[1] = k == 3 ? 269 : 700;
  for (std::size_t k : {4, 5}) driven.plant[k].state[vehicle::UX] = 29.5;
  s.region.x_max = 3;
  driven.plant[8].state[vehicle::X] = 3.4;
  driven.plant[9].state[vehicle::X] = 3.05;  // within what is not worth it
  const auto found = marks(s, driven);
  ASSERT_EQ(kinds(found), (Kinds{"wheel_load", "speed", "region"}));
  EXPECT_EQ(found[0].times, (std::vector<double>{driven.plant[2].t, driven.plant[6].t}));
  EXPECT_NE(found[0].text.find("fell to 269 N"), std::string::npos) << found[0].text;
  EXPECT_EQ(found[1].times.size(), 1u);
  EXPECT_NE(found[2].text.find("0.40 m outside"), std::string::npos) << found[2].text;
}

TEST(Marks, AVehicleThatMovesAwayForTenSecondsIsNamed) {
  auto s = open_field();
  s.loop.timeout = 20;
  s.goal.y = 100;
  s.goal.x = 30;  // which it passes at 5.9 s
  const auto found = marks(s, drive(s, straight_on));
  ASSERT_EQ(kinds(found), Kinds{"moves_away"});
  EXPECT_NEAR(found[0].times.at(0), 100 / 17., 0.05);
  s.loop.timeout = 15;
  EXPECT_EQ(kinds(marks(s, drive(s, straight_on))), Kinds{});
}

}  // namespace
}  // namespace slalom::sim
