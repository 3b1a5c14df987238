#include "slalom/problems/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "slalom/base/error.hpp"

namespace slalom::problems {
namespace {

using ocp::RefineStatus;

/// Two of them; all in all_slow_test.cpp.
TEST(Run, ComesToTheKnownValueByALocalAndAGlobalScheme) {
  for (const char* name : {"goddard", "gas-oil"})
    for (const char* scheme : {"hermite_simpson", "lgr"}) {
      SCOPED_TRACE(std::string(name) + " by " + scheme);
      const Entry& entry = find(library(), name);
      const auto result = run(entry, {.scheme = scheme});
      EXPECT_EQ(result.status, RefineStatus::converged);
      EXPECT_TRUE(result.agrees) << result.value;
      EXPECT_NEAR(result.value, entry.reference(), entry.tolerance());
      EXPECT_LE(result.error, entry.refinement);
    }
}

/// Each problem on its first mesh alone, quick; whole in all_slow_test.cpp.
TEST(Run, SolvesEveryProblemOnItsFirstMesh) {
  for (const auto& entry : library()) {
    SCOPED_TRACE(entry.name);
    const auto result = run(entry, {.refined = false});
    ASSERT_EQ(result.meshes.size(), 1u);
    EXPECT_EQ(result.meshes.front().status, nlp::Status::solved);
    EXPECT_TRUE(std::isfinite(result.value) && std::isfinite(result.error));
  }
}

TEST(Run, AnAnswerOfACoarseMeshDiffers) {
  const auto result = run(find(library(), "brachistochrone"),
                          {.scheme = "trapezoidal", .intervals = 5, .refined = false});
  EXPECT_EQ(result.status, RefineStatus::mesh_limit);
  EXPECT_FALSE(result.agrees);
  EXPECT_GT(std::fabs(result.difference), 1e-5);
}

TEST(Run, AMaximumHasItsSourcesSign) {
  EXPECT_GT(run(find(library(), "goddard"), {.refined = false}).value, 1);
}

TEST(Run, TakesSchemeMeshAndBackEnd) {
  const auto result = run(find(library(), "hager"),
                          {.scheme = "lgl", .points = 5, .intervals = 3, .refined = false});
  EXPECT_EQ(result.meshes.front().intervals, 3u);
  EXPECT_EQ(result.meshes.front().points, 13u);
  for (const auto& backend : nlp::backends())
    EXPECT_EQ(run(find(library(), "hager"), {.backend = backend}).backend.substr(0, backend.size()),
              backend);
  EXPECT_THROW((void)run(find(library(), "hager"), {.scheme = "simpson"}), InvalidValue);
  EXPECT_THROW((void)run(find(library(), "hager"), {.intervals = -1}), InvalidValue);
  EXPECT_THROW((void)run(find(library(), "hager"), {.tolerance = 2}), InvalidValue);
  EXPECT_THROW((void)run(find(library(), "hager"), {.backend = "knitro?"}), InvalidValue);
}

}  // namespace
}  // namespace slalom::problems
