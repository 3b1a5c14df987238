// What memory a solve takes, not how long: of many controls.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "slalom/ocp/solve.hpp"
#include "support/sanitized.hpp"

namespace slalom::ocp {
namespace {

/// A number of /proc/self/status [MiB]; 0 where there is none.
double status_mib(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kib = 0; word == key + ":" && status >> kib) return kib / 1024;
  return 0;
}

/// Makes this process's peak of memory what it has now; false where the system has no such thing.
bool forget_peak() {
  std::ofstream clear("/proc/self/clear_refs");
  clear << 5 << std::flush;
  return clear.good() && status_mib("VmHWM") > 0;
}

/// 400 controls that meet nothing but two states, in one stage: as one dense front of each stage
/// they took 475 MiB. Eliminated one by one they take 150.
TEST(Memory, OfManyControlsGrowsAsTheirNumber) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer's memory is its own";
  constexpr int kCount = 400;
  Problem p("many");
  const Expr x = p.state("x"), v = p.state("v");
  Expr force = 0, effort = 0;
  for (int i = 0; i < kCount; ++i) {
    const Expr u = p.control("u" + std::to_string(i), {0, 1});
    force = i < kCount / 2 ? force + u : force - u;
    effort = effort + square(u);
  }
  p.dynamics(x, v);
  p.dynamics(v, force / (kCount / 2.0) * 20);
  p.lagrange("effort", effort / (kCount / 2.0));
  p.fix(x, 0, 1);
  p.fix(v, 0, 0);
  if (!forget_peak()) GTEST_SKIP() << "no /proc/self/clear_refs to measure by";
  const double before = status_mib("VmRSS");
  const Solution solution = solve(p);
  const double grown = status_mib("VmHWM") - before;
  EXPECT_TRUE(solution.solved());
  EXPECT_NEAR(solution.objective, 0.03, 1e-6);  // 12 / 20^2
  EXPECT_LE(grown, 250) << "MiB";
}

}  // namespace
}  // namespace slalom::ocp
