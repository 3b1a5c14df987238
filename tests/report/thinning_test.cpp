#include "../../src/report/thinning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "report/synthetic_drive.hpp"

namespace slalom::report {
namespace {

using namespace testing;

bool has(const std::vector<std::size_t>& list, std::size_t k) {
  return std::find(list.begin(), list.end(), k) != list.end();
}

TEST(Thinning, KeepsAllSamplesThatFit) {
  const auto drive = synthetic_drive();
  std::vector<std::size_t> all(drive.plant.size());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(kept_samples(drive.plant, {}, all.size()), all);
  EXPECT_TRUE(kept_samples({}, {1}, 100).empty());
}

TEST(Thinning, KeepsBriefDipsAndMarkedMoments) {
  auto drive = synthetic_drive(8);
  const auto first = drive.plant[0];
  for (auto& sample : drive.plant) {
    const double t = sample.t;
    sample = first;
    sample.t = t;
    sample.state[vehicle::Y] = 17 * t;
  }
  EXPECT_LT(kept_samples(drive.plant, {}, 150).size(), 40U) << "what is straight needs few";
  // Beside these, dips that nothing shows which is only true to scale.
  drive.plant[10].wheel_loads[0] = 20'000;
  drive.plant[11].clearance += 15;
  drive.plant[12].wheel_loads[0] -= 1000;
  drive.plant[13].clearance -= 1;
  drive.plant[77].wheel_loads[0] -= 1;
  drive.plant[222].clearance -= 0.001;
  drive.plant[301].control[0] += 0.2;
  const auto kept = kept_samples(drive.plant, {3.001, 99}, 150);
  EXPECT_LE(kept.size(), 60U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  for (const std::size_t k : {0, 77, 151, 222, 301, 400}) EXPECT_TRUE(has(kept, k)) << k;
  EXPECT_GT(kept_samples(synthetic_drive(8).plant, {}, 150).size(), 100U);
}

TEST(Thinning, PutsCyclesThatTellSomethingFirst) {
  auto drive = synthetic_drive(100);
  auto& cycles = drive.cycles;
  for (auto& cycle : cycles) cycle.plan.report.wall_s = 0.01;
  cycles[50].plan.report.solved = false;
  cycles[90].plan.report.wall_s = 3;
  cycles[120].plan.goal_in_range = true;
  const auto order = by_weight(cycles, {cycles[33].t_swap = 16.1234});
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), cycles.size());
  // The first, the last and the worst; what changes, and changes back; what is marked.
  const std::vector<std::size_t> first(order.begin(), order.begin() + 16);
  for (const std::size_t k : {0, 199, 90, 50, 51, 120, 121, 33}) EXPECT_TRUE(has(first, k)) << k;
  // Of the others any beginning is even.
  std::vector<std::size_t> half(order.begin(), order.begin() + 100);
  std::sort(half.begin(), half.end());
  for (std::size_t i = 0; i + 1 < half.size(); ++i) EXPECT_LE(half[i + 1] - half[i], 4U);
  EXPECT_TRUE(by_weight({}, {}).empty());
}

}  // namespace
}  // namespace slalom::report
