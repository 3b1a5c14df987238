// One kernel set gives the same bits: from run to run, and however many solvers run side by side.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <thread>

#include "nlp/hock_schittkowski/problems.hpp"
#include "slalom/base/kernels.hpp"
#include "slalom/nlp/solver.hpp"
#include "support/kernel_sets.hpp"

namespace slalom::nlp {
namespace {

using Bits = std::vector<std::uint64_t>;

/// All that an answer says but times.
Bits bits_of(const Answer& answer) {
  Bits bits{static_cast<std::uint64_t>(answer.status),
            static_cast<std::uint64_t>(answer.iterations),
            std::bit_cast<std::uint64_t>(answer.objective),
            std::bit_cast<std::uint64_t>(answer.violation)};
  for (const auto* list : {&answer.point.x, &answer.point.y, &answer.point.zl, &answer.point.zu})
    for (const double v : *list) bits.push_back(std::bit_cast<std::uint64_t>(v));
  return bits;
}

/// Every sixth problem of the library, with a floor and without, by one solver each.
std::vector<Bits> solve_some() {
  std::vector<Bits> all;
  const auto problems = hock_schittkowski();
  for (std::size_t k = 0; k < problems.size(); k += 6) {
    ExpressionProblem problem(problems[k]);
    const auto solver = make_solver("interior_point");
    for (const double floor : {0.0, 0.1}) {
      Options options;
      options.floor = floor;
      options.max_iterations = 100;
      all.push_back(bits_of(solver->solve(problem, problem.cold_start(), options)));
    }
  }
  return all;
}

class SameBits : public OnKernelSet {};

TEST_P(SameBits, FromRunToRun) {
  const auto first = solve_some();
  EXPECT_GT(first.size(), 30u);
  EXPECT_EQ(first, solve_some());
}

TEST_P(SameBits, WithSolversSideBySideInThreads) {
  const auto alone = solve_some();
  for (const std::size_t count : {2u, 4u}) {
    std::vector<std::vector<Bits>> results(count);
    {
      std::vector<std::jthread> threads;
      for (auto& result : results) threads.emplace_back([&result] { result = solve_some(); });
    }
    for (const auto& result : results) EXPECT_EQ(alone, result) << count << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, SameBits, each_kernel_set(), name_of_set);

}  // namespace
}  // namespace slalom::nlp
