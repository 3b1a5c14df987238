// The planner's solves give the same bits however many planners run side by side.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <thread>

#include "planner/transcribed.hpp"
#include "slalom/base/kernels.hpp"
#include "support/kernel_sets.hpp"

namespace slalom::planner {
namespace {

using Bits = std::vector<std::uint64_t>;

/// Three cycles of each scene by interior_point, one after the other, each from the last plan.
Bits drive_a_while() {
  Bits bits;
  const auto add = [&](double v) { bits.push_back(std::bit_cast<std::uint64_t>(v)); };
  for (auto* scene : {&E_B, &E_C}) {
    Scene s = scene();
    s.planner.solver = SolverChoice::interior_point;
    auto planner = Planner(s);
    Request request = s.first;
    for (int cycle = 0; cycle < 3; ++cycle) {
      const Plan plan = planner.plan(request);
      EXPECT_TRUE(plan.report.solved);
      add(plan.tf);
      add(plan.report.phi);
      for (const auto& state : plan.states)
        for (const double v : state) add(v);
      const double tex = request.t_start - request.t0;
      request.t0 += tex;
      request.t_start += tex;
      request.X0p = plan.states[1];
    }
  }
  return bits;
}

class PlannerBits : public OnKernelSet {};

TEST_P(PlannerBits, SameOnAnyNumberOfThreads) {
  const Bits alone = drive_a_while();
  EXPECT_EQ(alone, drive_a_while());
  for (const std::size_t count : {2u, 4u}) {
    std::vector<Bits> results(count);
    {
      std::vector<std::jthread> threads;
      for (auto& result : results) threads.emplace_back([&result] { result = drive_a_while(); });
    }
    for (const auto& result : results) EXPECT_EQ(alone, result) << count << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, PlannerBits, each_kernel_set(), name_of_set);

}  // namespace
}  // namespace slalom::planner
