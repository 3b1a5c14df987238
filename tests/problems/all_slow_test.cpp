#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "slalom/problems/run.hpp"

namespace slalom::problems {
namespace {

/// refine()'s own tolerance, whatever an entry asks for; and how many times the error of the
/// objective that it states an answer may be off.
constexpr double kUsual = 1e-6, kTimesStated = 2;

/// Every problem, refined, from its plain guess with default options, to its known value. At the
/// usual tolerance, an answer that is farther off says so.
TEST(AllProblems, ComeToTheirKnownValuesByALocalAndAGlobalScheme) {
  for (const auto& entry : library())
    for (const char* scheme : {"hermite_simpson", "lgr"}) {
      SCOPED_TRACE(entry.name + " by " + scheme);
      const auto result = run(entry, {.scheme = scheme});
      EXPECT_TRUE(result.agrees) << to_string(result.status) << ", " << result.value << " for "
                                 << entry.reference();
      const auto usual =
          entry.refinement == kUsual ? result : run(entry, {.scheme = scheme, .tolerance = kUsual});
      EXPECT_EQ(usual.status, ocp::RefineStatus::converged);
      const double stated = usual.meshes.back().objective_error * std::fabs(entry.reference());
      EXPECT_NEAR(usual.value, entry.reference(),
                  std::max(entry.tolerance(), kTimesStated * stated));
    }
}

}  // namespace
}  // namespace slalom::problems
