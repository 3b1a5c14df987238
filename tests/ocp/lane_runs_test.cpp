// LaneRuns against the plain loop over its list, on every kernel set.

#include "../../src/ocp/lane_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "slalom/base/kernels.hpp"
#include "support/kernel_sets.hpp"

namespace slalom::ocp {
namespace {

using Vector = std::vector<double>;

constexpr std::size_t kSources = 200, kTargets = 200;

/// A run of `count` with these steps, from the middle of both arrays; all ones or not.
std::vector<Scatter> run_of(std::size_t count, int source_step, int target_step, bool ones) {
  std::vector<Scatter> list;
  for (std::size_t i = 0; i < count; ++i) {
    const int k = static_cast<int>(i);
    list.push_back({static_cast<std::uint32_t>(100 + source_step * k),
                    static_cast<std::uint32_t>(90 + target_step * k),
                    ones ? 1.0 : 0.5 + 0.25 * static_cast<double>(i)});
  }
  return list;
}

/// Runs of every kind one after the other: steps -1, 0, 1, 2 of both sides, single entries too.
std::vector<std::vector<Scatter>> lists() {
  std::vector<std::vector<Scatter>> all;
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 8u, 17u})
    for (const int source : {-1, 0, 1, 2})
      for (const int target : {-1, 0, 1, 2})
        for (const bool ones : {false, true}) all.push_back(run_of(count, source, target, ones));
  std::vector<Scatter> together;
  for (const auto& list : all) together.insert(together.end(), list.begin(), list.end());
  all.push_back(together);
  std::vector<Scatter> wild;
  std::mt19937 random(4);
  for (int i = 0; i < 150; ++i)
    wild.push_back({static_cast<std::uint32_t>(random() % kSources),
                    static_cast<std::uint32_t>(random() % kTargets), 0.01 * i});
  all.push_back(wild);
  all.emplace_back();
  return all;
}

Vector numbers(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector v(n);
  for (double& x : v) x = uniform(random);
  return v;
}

void expect_near(const Vector& a, const Vector& b) {
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-11) << "at " << i;
}

class Lanes : public OnKernelSet {};

TEST_P(Lanes, ScatterAddsAndGatherIsItsTranspose) {
  for (const auto& list : lists()) {
    const LaneRuns runs(list);
    const Vector from = numbers(kSources, 1), back_from = numbers(kTargets, 2);
    Vector to = numbers(kTargets, 3), back = numbers(kSources, 4), constant = back;
    Vector sought = to, back_sought = back, constant_sought = back;
    for (const auto& s : list) {
      sought[s.target] += s.coefficient * from[s.source];
      back_sought[s.source] += s.coefficient * back_from[s.target];
      constant_sought[s.source] += s.coefficient * 3.0;
    }
    runs.scatter(from, to);
    runs.gather(back_from, back);
    runs.add_to_sources(3.0, constant);
    expect_near(to, sought);
    expect_near(back, back_sought);
    expect_near(constant, constant_sought);
  }
}

TEST_P(Lanes, FirstWritersSetAndLaterOnesAdd) {
  for (const auto& list : lists()) {
    std::vector<char> written(kTargets, 0);
    const std::vector<Scatter> first(list.begin(),
                                     list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2));
    const std::vector<Scatter> second(list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2),
                                      list.end());
    const LaneRuns a(first, &written), b(second, &written), c(list, &written);
    const Vector from = numbers(kSources, 5);
    // What stood there before does not matter where something is written, not even if not finite.
    Vector to(kTargets, std::numeric_limits<double>::quiet_NaN()), sought(kTargets, 0.0);
    std::vector<char> touched(kTargets, 0);
    for (const auto& s : list) {
      sought[s.target] += 2 * s.coefficient * from[s.source];
      touched[s.target] = 1;
    }
    a.scatter(from, to);
    b.scatter(from, to);
    c.scatter(from, to);  // all its targets are written already: it adds
    for (std::size_t t = 0; t < kTargets; ++t) {
      EXPECT_EQ(written[t], touched[t]);
      if (touched[t]) {
        ASSERT_NEAR(to[t], sought[t], 1e-11) << "target " << t;
      } else {
        EXPECT_TRUE(std::isnan(to[t]));
      }
    }
  }
}

TEST_P(Lanes, EvenStepsMakeOneRun) {
  for (const int source : {-1, 0, 1, 2})
    for (const int target : {-1, 0, 1, 2})
      EXPECT_EQ(LaneRuns(run_of(9, source, target, false)).runs(), 1u);
  EXPECT_EQ(LaneRuns(std::vector<Scatter>{}).runs(), 0u);
}

TEST_P(Lanes, AllFiniteSeesEveryPlaceAndOverflowsOnNothing) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n <= 19; ++n) {
    Vector v(n, std::numeric_limits<double>::max());
    EXPECT_TRUE(lane_kernels().all_finite(v.data(), n)) << n;
    for (std::size_t i = 0; i < n; ++i)
      for (const double bad : {kInf, -kInf, std::numeric_limits<double>::quiet_NaN()}) {
        v[i] = bad;
        EXPECT_FALSE(lane_kernels().all_finite(v.data(), n)) << i << " of " << n;
        v[i] = 1;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, Lanes, each_kernel_set(), name_of_set);

}  // namespace
}  // namespace slalom::ocp
